#!/usr/bin/env bash
# Tests the Rust side against an installed library: bindings/rust/run-tests.sh LIB_DIR LOG_FILE TARGET_DIR
#
#   LIB_DIR      the folder with libraywise.so and libraywise.so.1
#   LOG_FILE     receives all that is said, beside standard output
#   TARGET_DIR   where cargo builds
#
# In this order: the committed declarations are those of the header; the circle from the header to Rust and back closes,
# and notices damage (the generator's tests); the crates' tests; the example. All of it runs even when a part fails; the
# exit code is then 1. RAYWISE_PYTHON names the Python for generate.py (python3 if unset). The first run downloads crates.
set -euo pipefail

if [[ $# -ne 3 ]]; then
    sed -n '2s/^# //p' "$0" >&2
    exit 2
fi

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
if [[ ! -e $1/libraywise.so ]]; then
    echo "run-tests.sh: there is no libraywise.so in $1" >&2
    exit 2
fi
lib_dir=$(cd "$1" && pwd)
mkdir -p "$(dirname "$2")" "$3"
log=$(cd "$(dirname "$2")" && pwd)/$(basename "$2")
: >"$log"

CARGO_TARGET_DIR=$(cd "$3" && pwd)
RAYWISE_LIB_DIR=$lib_dir
# The tests carry the folder with them; tests in the documentation and the example look here.
LD_LIBRARY_PATH=$lib_dir${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
CARGO_TERM_COLOR=never
export CARGO_TARGET_DIR RAYWISE_LIB_DIR LD_LIBRARY_PATH CARGO_TERM_COLOR
unset DOCS_RS

python=${RAYWISE_PYTHON:-python3}
failures=()

# NAME COMMAND...: runs a part; output goes to the log as well.
part() {
    local name=$1
    shift
    printf '\n--- %s\n' "$name" | tee -a "$log"
    if ! "$@" </dev/null 2>&1 | tee -a "$log"; then
        failures+=("$name")
    fi
}

part "declarations and header" "$python" "$root/bindings/generate.py" --check --circle --only rust
part "generator" cargo test --locked --manifest-path "$root/bindings/generator/Cargo.toml"
part "crates" cargo test --locked --manifest-path "$here/Cargo.toml" --workspace --no-fail-fast
# As the tests were built: another profile would build the crates it depends on once more.
part "example" cargo run --locked --manifest-path "$root/examples/rust/Cargo.toml"

if [[ ${#failures[@]} -gt 0 ]]; then
    printf '\nfailed: %s\n' "${failures[*]}" | tee -a "$log"
    exit 1
fi
printf '\nall Rust parts passed\n' | tee -a "$log"
