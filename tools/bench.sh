#!/usr/bin/env bash
# tools/bench.sh          builds the benchmarks (preset bench) and runs them; each prints a table and leaves
#                         build/reports/NAME.json behind
# tools/bench.sh rust     raywise beside ray tracing crates instead (make bench-rust)
# tools/bench.sh python   raywise beside Python's ray libraries instead (make bench-python)
#
# From the environment:
#   QUICK=1       small scenes and short timings, to see that they run
#   BENCH_FLAGS   more options of raywise_bench, which then runs alone: --help lists them; for the crates, which scenes;
#                 for Python those of tests/bench/python/bench_python.py
#
# Meshes are taken from the data folder beside the project, or RAYWISE_TEST_DATA, where there is one. The dragon is
# downloaded where there is npm, but not for QUICK=1. What is not there is left out, and said so.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly BUILD=$ROOT/build/bench
readonly REPORTS=$ROOT/build/reports
readonly RUST=$ROOT/tests/bench/rust
readonly PYTHON_BENCH=$ROOT/tests/bench/python/bench_python.py
readonly DATA=${RAYWISE_TEST_DATA:-$ROOT/../shared/data/meshes}

read -ra flags <<<"${BENCH_FLAGS:-}"
goal=bench${1:+-$1}
command="make $goal"
[[ ${QUICK:-} != 1 ]] || command+=" QUICK=1"
[[ -z ${BENCH_FLAGS:-} ]] || command+=" BENCH_FLAGS='$BENCH_FLAGS'"
common=(--commit "$(git describe --always --dirty 2>/dev/null || echo unknown)")
[[ ${QUICK:-} != 1 ]] || common+=(--quick)

# embreex carries a whole Embree 4 in its wheel.
embree4() { compgen -G "$BENCH_VENV/lib/python*/site-packages/embreex.libs/libembree4*.so*" | head -n 1 || true; }

# Built where there is AVX2 to force.
readonly AVX2=$BUILD/tests/bench/libraywise-avx2.so

readonly BENCH=$BUILD/tests/bench/raywise_bench
readonly LIBRARY=$BUILD/capi/libraywise.so.1
scene_files=(--meshes "$DATA" --spd "$DATA/../spd" --dragon "$DRAGON")

raywise_bench() {
    local avx2=
    [[ ! -e $AVX2 ]] || avx2=$AVX2
    "$BENCH" --library "$LIBRARY" --library-avx2 "$avx2" --embree4 "$(embree4)" "${scene_files[@]}" "${common[@]}" \
        "${flags[@]}" "$@"
}

against_peers() {
    step "raywise beside its peers"
    raywise_bench --json "$REPORTS/bench.json" --command "$command" | tee "$REPORTS/bench.txt"
    note "written to build/reports/bench.json and bench.txt, and drawn beside them:"
    "$BENCH_VENV/bin/python" tests/bench/plots.py "$REPORTS/bench.json" "$REPORTS"
}

# The same scenes and rays as the others get, through files.
against_crates() {
    local scenes=$ROOT/build/bench-scenes target=$ROOT/build/cargo-bench
    step "Writing scenes and rays"
    rm -rf "$scenes" "$target/criterion"
    raywise_bench --export "$scenes"
    step "raywise beside ray tracing crates"
    RAYWISE_CALIBRATION=builtin RAYWISE_LIB_DIR=$BUILD/capi LD_LIBRARY_PATH=$BUILD/capi RAYWISE_BENCH_SCENES=$scenes \
        RAYWISE_BENCH_QUICK=${QUICK:-} CARGO_TARGET_DIR=$target \
        cargo bench --locked --manifest-path "$RUST/Cargo.toml"
    "$BENCH_VENV/bin/python" tests/bench/rust_report.py "$target/criterion" "$REPORTS/bench.json" \
        "$REPORTS/bench-rust.json" "${common[1]}" "$command"
    note "written to build/reports/bench-rust.json"
}

# The flags come last, so that a --json among them is the one that counts; the exporter gets its own.
against_python() {
    local -a quick=()
    [[ ${QUICK:-} != 1 ]] || quick=(--quick)
    step "raywise beside Python's ray libraries"
    RAYWISE_LIBRARY=$LIBRARY PYTHONPATH=$ROOT/bindings/python PYTHONDONTWRITEBYTECODE=1 \
        "$BENCH_PYTHON_VENV/bin/python" "$PYTHON_BENCH" "$ROOT/build/bench-scenes-python" \
        --json "$REPORTS/bench-python.json" --command "$command" "${common[@]}" "${flags[@]}" \
        -- "$BENCH" --library "$LIBRARY" "${scene_files[@]}" "${quick[@]}" | tee "$REPORTS/bench-python.txt"
    note "written to build/reports/bench-python.json and bench-python.txt"
}

triangle_test() {
    step "What the exact triangle test costs"
    "$BUILD/tests/bench/bench_triangle_test" exact="$BUILD/capi/libraywise.so.1" \
        plain="$BUILD/tests/bench/libraywise-plain.so" --data "$DATA" --json "$REPORTS/triangle-test.json" \
        "${common[@]}"
    note "written to build/reports/triangle-test.json"
}

if [[ ${QUICK:-} != 1 ]] && have npm; then
    fetch_dragon || note "the dragon cannot be downloaded"
fi

step "Building the benchmarks"
cmake --preset bench
if [[ $goal != bench || -n ${BENCH_FLAGS:-} ]]; then
    cmake --build --preset bench --target raywise_bench
else
    cmake --build --preset bench
fi

mkdir -p "$REPORTS"
case $goal in
bench-rust) against_crates ;;
bench-python) against_python ;;
*)
    against_peers
    [[ -n ${BENCH_FLAGS:-} ]] || triangle_test
    ;;
esac
