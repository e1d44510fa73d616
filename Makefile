# The commands of the project, for people and for the pipeline alike. Each goal first sees to it that the
# machine has what it needs (tools/setup.sh). Builds are the presets of CMakePresets.json, under build/.

.DEFAULT_GOAL := help
SHELL := /bin/bash

# Goals run in the order they are written; each build uses all cores by itself.
.NOTPARALLEL:

# Where tools/setup.sh puts a Rust toolchain that has to come before the one on PATH.
export PATH := $(CURDIR)/build/toolchain/bin:$(PATH)

# Read by the scripts under tools/ and by build tools.
export MESH SCENE RAYS OUT DEMO_FLAGS TEST_FLAGS JOBS QUICK PEERS

CALIBRATE_FLAGS ?=

.PHONY: help
help: ## list the goals
	@echo "make GOAL, where GOAL is one of:"
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  %-15s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

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
test-tsan: ## tests of threads with the thread sanitizer
	@tools/setup.sh native
	@tools/test.sh tsan

.PHONY: coverage
coverage: ## which lines the C and C++ tests run; pages in build/coverage/report
	@tools/setup.sh native coverage
	@tools/coverage.sh

.PHONY: bench
bench: ## build the benchmarks, into build/bench
	@tools/setup.sh bench
	cmake --preset bench
	cmake --build --preset bench

.PHONY: contract-peers
contract-peers: ## the hard cases before other libraries [QUICK=1] [PEERS='embree cgal ...']
	@tools/setup.sh native peers
	@tools/contract-peers.sh

.PHONY: bindings
bindings: ## regenerate the Rust and Python declarations from the header
	@tools/setup.sh bindings
	build/venv/bin/python bindings/generate.py

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
