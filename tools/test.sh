#!/usr/bin/env bash
# tools/test.sh          all tests: the dev preset under ctest (C, C++, examples, Rust and Python), then the
#                        tests of threads under the thread sanitizer, then every fuzzer for a short while.
#                        Ends with the closing line of every runner, so that nobody has to take ctest's
#                        word for the languages behind it.
# tools/test.sh PRESET   configure, build and test one preset with all C and C++ tests: asan-ubsan, tsan, coverage;
#                        or the fuzzers: fuzz
#
# TEST_FLAGS in the environment goes to ctest, e.g. TEST_FLAGS='-R grid'; JOBS is how many run at a time.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly LOGS=$ROOT/build/dev/logs
readonly PREFIX=$ROOT/build/prefix-test
JOBS=${JOBS:-$(nproc)}

read -ra flags <<<"${TEST_FLAGS:-}"
failures=()

ctest_log() { # PRESET
    if [[ $1 == dev ]]; then
        echo "$LOGS/ctest.log"
    else
        echo "$ROOT/build/$1/ctest.log"
    fi
}

configure() { # PRESET
    step "Configuring preset $1"
    cmake --preset "$1"
}

build() { # PRESET [TARGET]
    step "Building preset $1"
    cmake --build --preset "$1" ${2:+--target "$2"}
}

# The thread sanitizer wants its shadow memory at fixed addresses and gives up where the kernel places
# things at random beyond them; setarch turns that off, where it is allowed to.
fixed_addresses() {
    if setarch "$(uname -m)" -R true 2>/dev/null; then
        setarch "$(uname -m)" -R "$@"
    else
        "$@"
    fi
}

run_ctest() { # PRESET [TEST PRESET]
    local preset=${2:-$1}
    local -a command=(ctest --preset "$preset" -j "$JOBS" "${flags[@]}")
    [[ $1 != tsan ]] || command=(fixed_addresses "${command[@]}")
    step "Testing preset $preset (ctest)"
    "${command[@]}" </dev/null 2>&1 | tee "$(ctest_log "$1")"
}

# Examples and bindings are tested against an installed library, never against the build tree.
install_for_tests() {
    step "Installing into build/prefix-test"
    rm -rf "$PREFIX"
    cmake --install build/dev >/dev/null
}

# Whatever is in the logs afterwards was said by this run.
empty_logs() {
    rm -rf "$LOGS"
    mkdir -p "$LOGS"
}

# --- the summary ------------------------------------------------------------------------------------

# PRESET: shows ctest's closing line. ctest's own exit code was looked at already; without the line it did
# not get to its end.
report_ctest() {
    grep -E '^[0-9]+% tests passed, [0-9]+ tests? failed out of [0-9]+' "$(ctest_log "$1")" | tail -n 1 ||
        failures+=("ctest, preset $1: no closing line")
}

# PRESET: the tests that took longest, so that nobody has to look for what to make shorter.
readonly SLOWEST=10
report_slowest() {
    printf 'the %d slowest (seconds)\n' "$SLOWEST"
    sed -nE 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+) \.*.* +([0-9]+\.[0-9]+) sec$/\2 \1/p' "$(ctest_log "$1")" |
        sort -rn | awk -v most="$SLOWEST" 'NR <= most { printf "%9.1f  %s\n", $1, $2 }' # head would break the pipe
}

# cargo prints one line per test program, and one saying 0 for each that has no tests.
closing_lines_rust() { grep -hE '^test result: ' "$LOGS"/rust*.log | grep -vE ' 0 passed; 0 failed; 0 ignored'; }

closing_lines_python() {
    local log
    for log in "$LOGS"/python*.log; do
        [[ -f $log ]] || continue
        grep -E '(passed|failed|error|no tests ran).* in [0-9.]+s' "$log" | tail -n 1
    done
}

passed() { # reads closing lines, sums up "N passed"
    grep -oE '[0-9]+ passed' | awk '{ sum += $1 } END { print sum + 0 }'
}

# NAME LINES: shows them, and counts it as a failure when one of them tells of failures, or when nothing ran
# although everything was asked for.
report() {
    printf '\n%s\n' "$1"
    if [[ -n $2 ]]; then
        printf '%s\n' "$2"
    fi
    if grep -E '[1-9][0-9]* (failed|errors?)' <<<"$2" >/dev/null; then
        failures+=("$1")
    elif [[ $(passed <<<"$2" || true) -gt 0 ]]; then
        return 0
    elif [[ ${#flags[@]} -gt 0 ]]; then
        echo "none in this selection (TEST_FLAGS)"
    else
        echo "no test ran"
        failures+=("$1: no test ran")
    fi
}

summary() {
    step "Summary"
    printf '\nC and C++, and all that follows (ctest, preset dev)\n'
    report_ctest dev
    report_slowest dev
    report "Rust (cargo test)" "$(closing_lines_rust 2>/dev/null || true)"
    report "Python (pytest)" "$(closing_lines_python || true)"
    if [[ ${#flags[@]} -eq 0 ]]; then
        printf '\nThreads (ctest, preset tsan)\n'
        report_ctest tsan
        printf '\nFuzzers, a short while each (ctest, preset fuzz)\n'
        report_ctest fuzz
    fi
}

test_everything() {
    configure dev
    build dev
    install_for_tests
    empty_logs
    run_ctest dev || failures+=("ctest, preset dev")

    # A selection is somebody at work on one thing: no other presets for them; there are make test-tsan and make fuzz.
    if [[ ${#flags[@]} -eq 0 ]]; then
        configure tsan
        build tsan tests-of-threads
        run_ctest tsan tsan-threads || failures+=("ctest, preset tsan-threads")
        configure fuzz
        build fuzz
        run_ctest fuzz || failures+=("ctest, preset fuzz")
    fi

    summary
    if [[ ${#failures[@]} -gt 0 ]]; then
        printf '\nraywise: FAILED\n' >&2
        printf '    %s\n' "${failures[@]}" >&2
        exit 1
    fi
}

test_one_preset() { # PRESET
    configure "$1"
    build "$1"
    run_ctest "$1"
}

if [[ $# -gt 0 ]]; then
    test_one_preset "$1"
else
    test_everything
fi
