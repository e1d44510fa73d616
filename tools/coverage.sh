#!/usr/bin/env bash
# Runs the coverage preset's tests and reports which lines of the library they ran.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly REPORT=build/coverage/report

# Counts of an earlier run would be added to.
if [[ -d build/coverage ]]; then
    find build/coverage -name '*.gcda' -delete
fi

tools/test.sh coverage

step "Writing the report"
mkdir -p "$REPORT"
gcovr --root . --object-directory build/coverage --filter 'src/' --filter 'capi/' --filter 'calibration/' \
    --exclude-throw-branches --print-summary --html-details "$REPORT/index.html" build/coverage
note "$REPORT/index.html"
