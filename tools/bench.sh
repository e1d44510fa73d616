#!/usr/bin/env bash
# tools/bench.sh    builds the benchmarks (preset bench) and runs them; each prints a table and leaves
#                   build/reports/NAME.json behind
#
# From the environment: QUICK=1, small scenes and short timings, to see that they run.
# Meshes are taken from the data folder beside the project, or RAYWISE_TEST_DATA, where there is one.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly BUILD=$ROOT/build/bench
readonly REPORTS=$ROOT/build/reports
readonly DATA=${RAYWISE_TEST_DATA:-$ROOT/../shared/data/meshes}

common=(--data "$DATA" --commit "$(git describe --always --dirty 2>/dev/null || echo unknown)")
[[ ${QUICK:-} != 1 ]] || common+=(--quick)

step "Building the benchmarks"
cmake --preset bench
cmake --build --preset bench

step "What the exact triangle test costs"
"$BUILD/tests/bench/bench_triangle_test" exact="$BUILD/capi/libraywise.so.1" \
    plain="$BUILD/tests/bench/libraywise-plain.so" plain-float="$BUILD/tests/bench/libraywise-plain-float.so" \
    --json "$REPORTS/triangle-test.json" "${common[@]}"
note "written to build/reports/triangle-test.json"
