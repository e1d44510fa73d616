# The commands of the project, for people and for the pipeline alike. Each goal first sees to it that the
# machine has what it needs (tools/setup.sh). Builds are the presets of CMakePresets.json, under build/.

.DEFAULT_GOAL := help
SHELL := /bin/bash

# Goals run in the order they are written; each build uses all cores by itself.
.NOTPARALLEL:

# Where tools/setup.sh puts a Rust toolchain that has to come before the one on PATH.
export PATH := $(CURDIR)/build/toolchain/bin:$(PATH)

# Read by the scripts under tools/ and by build tools.
export MESH SCENE RAYS OUT DEMO_FLAGS TEST_FLAGS JOBS QUICK SEED CONTRACT_FLAGS PEERS BENCH_FLAGS

CALIBRATE_FLAGS ?=

.PHONY: help
help: ## list the goals
	@echo "make GOAL, where GOAL is one of:"
	@awk -F ':.*## ' '/^[a-z0-9-]+:.*## / { printf "  %-15s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

.PHONY: setup
setup: ## install all that any goal needs
	@tools/setup.sh all

.PHONY: build
build: ## build the release and install it into build/prefix
	@tools/setup.sh demo
	cmake --preset release
	cmake --build --preset release
	cmake --install build/release >/dev/null

.PHONY: demo
demo: ## a picture and a table [MESH=file | SCENE=sphereflake|terrain|dragon] [RAYS=N] [OUT=demo.png]
	@tools/demo.sh --check
	@$(MAKE) --no-print-directory build
	@tools/demo.sh

.PHONY: test
test: ## all tests, all languages [TEST_FLAGS='ctest flags']
	@tools/setup.sh test
	@tools/test.sh

.PHONY: test-asan
test-asan: ## C and C++ tests with the address and undefined behaviour sanitizers
	@tools/setup.sh native
	@tools/test.sh asan-ubsan

.PHONY: test-tsan
test-tsan: ## C and C++ tests with the thread sanitizer
	@tools/setup.sh native
	@tools/test.sh tsan

.PHONY: isa-aarch64
isa-aarch64: ## whether an AArch64 processor gives the same bits, in an emulator
	@tools/setup.sh native isa-aarch64
	@tools/isa-aarch64.sh

.PHONY: fuzz
fuzz: ## all fuzzers, each for so long [SECONDS=60] [SEED=N]
	@tools/setup.sh fuzz
	@env -u SECONDS FUZZ_SECONDS=$(or $(SECONDS),60) tools/fuzz.sh

.PHONY: coverage
coverage: ## which lines the C and C++ tests run; pages in build/coverage/report
	@tools/setup.sh native coverage
	@tools/coverage.sh

.PHONY: bench
bench: ## speed beside other libraries; reports in build/reports [QUICK=1] [BENCH_FLAGS='--scene bunny ...']
	@tools/setup.sh bench
	@tools/bench.sh

.PHONY: bench-rust
bench-rust: ## speed beside Rust crates; build/reports/bench-rust.json [QUICK=1] [BENCH_FLAGS='--scene bunny ...']
	@tools/setup.sh bench bench-rust
	@tools/bench.sh rust

.PHONY: bench-python
bench-python: ## speed beside Python's ray libraries; build/reports/bench-python.json [QUICK=1] [BENCH_FLAGS='--threads all ...']
	@tools/setup.sh bench bench-python
	@tools/bench.sh python

.PHONY: growth
growth: ## whether very many calls leave anything behind [CALLS=1000000] [KIND='commit, bvh']
	@tools/setup.sh native
	cmake --preset dev >/dev/null
	cmake --build --preset dev --target capi_growth_test
	RAYWISE_CALIBRATION=builtin build/dev/tests/capi/capi_growth_test $(or $(CALLS),1000000) "$(KIND)"

.PHONY: contract
contract: ## the correctness contract: hard cases and long sweeps [QUICK=1] [SEED=N]
	@tools/setup.sh native
	@tools/contract.sh

.PHONY: contract-peers
contract-peers: ## the hard cases before other libraries [QUICK=1] [PEERS='embree cgal ...']
	@tools/setup.sh native peers
	@tools/contract-peers.sh

.PHONY: bindings
bindings: ## regenerate the Rust and Python declarations from the header
	@tools/setup.sh bindings
	build/venv/bin/python bindings/generate.py

.PHONY: abi
abi: ## keep the binary interface as the one of this release (CONTRIBUTING.md, Releases)
	@tools/setup.sh native abi
	cmake --preset dev
	cmake --build --preset dev --target raywise
	tools/abi.py write --library build/dev/capi/libraywise.so

.PHONY: calibrate
calibrate: build ## measure this machine [CALIBRATE_FLAGS=...]
	build/prefix/bin/raywise-calibrate $(CALIBRATE_FLAGS)

.PHONY: format
format: ## lay out the C and C++ sources
	@tools/setup.sh format
	@tools/format.sh

.PHONY: format-check
format-check: ## fail if make format would change something
	@tools/setup.sh format
	@tools/format.sh --check

.PHONY: clean
clean: ## remove build/ and all in it
	rm -rf build
