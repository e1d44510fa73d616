#!/usr/bin/env bash
# Runs the tests of the Python package and the Python example against one library file.
#
#   run-tests.sh LIBRARY LOG
#
# LIBRARY  path of libraywise.so.1
# LOG      file that receives a copy of what is printed, pytest's closing line last
#
# RAYWISE_PYTHON names the interpreter (default: python3); it needs requirements-test.txt.
# RAYWISE_PYTEST_FLAGS adds options for pytest, e.g. '-k parity'.
set -euo pipefail

if [[ $# -ne 2 ]]; then
    echo "usage: run-tests.sh LIBRARY LOG" >&2
    exit 2
fi
library=$(realpath -- "$1")
log=$(realpath -m -- "$2")
package=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
example=$package/../../examples/python/sphere.py
python=${RAYWISE_PYTHON:-python3}
read -ra flags <<<"${RAYWISE_PYTEST_FLAGS:-}"

mkdir -p -- "$(dirname -- "$log")"
export RAYWISE_LIBRARY=$library
export PYTHONPATH=$package${PYTHONPATH:+:$PYTHONPATH}
export PYTHONDONTWRITEBYTECODE=1

# Both run, whatever the first one says.
failed=0
"$python" "$example" 2>&1 | tee -- "$log" || failed=1
(cd -- "$package" && "$python" -m pytest "${flags[@]}" tests) 2>&1 | tee -a -- "$log" || failed=1
exit "$failed"
