#!/usr/bin/env bash
# The fuzzers at the desk: each for FUZZ_SECONDS (default 60), as many at a time as there are cores, from the kept corpus and
# from what earlier runs left in build/fuzz/NAME/corpus. Prints a table and writes build/reports/fuzz.json. A crash, a leak, a
# hang or too much memory leaves its input in build/fuzz/NAME/ and fails, with the command that replays it. Ctrl-C ends
# early with a report of what was done.
#
#   tools/fuzz.sh               all of them
#   tools/fuzz.sh NAME...       only these
#   tools/fuzz.sh --merge NAME  puts into the kept corpus what build/fuzz/NAME/corpus reaches beyond it
#
# From the environment: FUZZ_SECONDS; SEED, of the mutations (default: another one each time); JOBS, how many at a time.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly KEPT=$ROOT/tests/fuzz/corpus
readonly PROGRAMS=$ROOT/build/fuzz/tests/fuzz
readonly REPORT=$ROOT/build/reports/fuzz.json
readonly FUZZ_SECONDS=${FUZZ_SECONDS:-60}
JOBS=${JOBS:-$(nproc)}

export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_stack_use_after_return=1:strict_string_checks=1}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-halt_on_error=1:print_stacktrace=1}

all_fuzzers() {
    local source
    for source in tests/fuzz/fuzz_*.cpp; do
        basename "$source" .cpp
    done
}

build() {
    step "Building preset fuzz"
    cmake --preset fuzz >/dev/null
    cmake --build --preset fuzz
}

folder() { echo "$ROOT/build/fuzz/$1"; }
log() { echo "$(folder "$1")/log.txt"; }

# Those that CMake knows for this fuzzer (input size, limits, dictionary), one a line; the same as under ctest.
read_flags() { mapfile -t flags <"$PROGRAMS/$1.flags"; }

# NAME: runs one fuzzer, with all it says in its log.
run_fuzzer() {
    local -a flags
    read_flags "$1"
    mkdir -p "$(folder "$1")/corpus"
    [[ -z ${SEED:-} ]] || flags+=("-seed=$SEED")
    "$PROGRAMS/$1" "${flags[@]}" "-max_total_time=$FUZZ_SECONDS" -print_final_stats=1 \
        "$(folder "$1")/corpus" "$KEPT/$1" >"$(log "$1")" 2>&1
}

# --- what a log says --------------------------------------------------------------------------------

statistic() { # NAME STATISTIC
    awk -v key="stat::$2:" '$1 == key { value = $2 } END { print value + 0 }' "$(log "$1")"
}

coverage() { # NAME: counters of the code that were reached
    grep -oE 'cov: [0-9]+' "$(log "$1")" | tail -n 1 | grep -oE '[0-9]+' || echo 0
}

# Inputs that this run left behind.
reproducers() { # NAME
    find "$(folder "$1")" -maxdepth 1 -type f -newer "$PROGRAMS/started" \
        \( -name 'crash-*' -o -name 'leak-*' -o -name 'timeout-*' -o -name 'oom-*' \)
}

# Newest figures of all running fuzzers, in one line for a person who waits.
show_progress() {
    local name line=""
    for name in "$@"; do
        line+="  $name $(grep -oE '^#[0-9]+' "$(log "$name")" 2>/dev/null | tail -n 1)"
    done
    printf '\r\033[K    %ds%s' "$((SECONDS - started_at))" "$line" >&2
}

# --- running ----------------------------------------------------------------------------------------

run_all() { # NAME...
    local name pid
    local -A names=() # by process
    local -a waiting=("$@")
    started_at=$SECONDS
    while [[ ${#waiting[@]} -gt 0 || ${#names[@]} -gt 0 ]]; do
        while [[ ${#waiting[@]} -gt 0 && ${#names[@]} -lt $JOBS && $interrupted == no ]]; do
            name=${waiting[0]}
            waiting=("${waiting[@]:1}")
            run_fuzzer "$name" &
            names[$!]=$name
        done
        [[ $interrupted == no ]] || waiting=()
        for pid in "${!names[@]}"; do
            kill -0 "$pid" 2>/dev/null && continue
            wait "$pid" || failed+=("${names[$pid]}")
            done_names+=("${names[$pid]}")
            unset "names[$pid]"
        done
        [[ ! -t 2 ]] || show_progress "${names[@]}"
        sleep 1 || true
    done
    [[ ! -t 2 ]] || printf '\r\033[K' >&2
}

# --- the report -------------------------------------------------------------------------------------

commit() { git describe --always --dirty --abbrev=12 --exclude='*' 2>/dev/null || echo unknown; }
machine() {
    local brand
    brand=$(sed -n '/^model name/{s/^[^:]*: //p;q}' /proc/cpuinfo)
    echo "${brand:-$(uname -m)}, $(nproc) threads"
}
json_text() { sed 's/\\/\\\\/g; s/"/\\"/g' <<<"$1"; }

report() {
    local name executions rate reached crashes rows="" sum=0 crash_sum=0
    printf '\n%-14s %12s %10s %10s %8s\n' target executions exec/s coverage crashes
    for name in "${done_names[@]}"; do
        executions=$(statistic "$name" number_of_executed_units)
        rate=$(statistic "$name" average_exec_per_sec)
        reached=$(coverage "$name")
        crashes=$(reproducers "$name" | wc -l)
        # Something went wrong without an input to show for it: that counts as well.
        if [[ $crashes -eq 0 && $interrupted == no && " ${failed[*]} " == *" $name "* ]]; then
            crashes=1
        fi
        printf '%-14s %12d %10d %10d %8d\n' "$name" "$executions" "$rate" "$reached" "$crashes"
        rows+="${rows:+,}
    {\"fuzzer\": \"$name\", \"executions\": $executions, \"executions_per_second\": $rate, \"coverage\": $reached, \"crashes\": $crashes}"
        sum=$((sum + executions))
        crash_sum=$((crash_sum + crashes))
    done
    mkdir -p "$(dirname "$REPORT")"
    cat >"$REPORT" <<END
{
  "target": "fuzz",
  "machine": "$(json_text "$(machine)")",
  "commit": "$(json_text "$(commit)")",
  "date": "$(date -u +%Y-%m-%dT%H:%M:%SZ)",
  "command": "make fuzz SECONDS=$FUZZ_SECONDS${SEED:+ SEED=$SEED}",
  "rows": [$rows
  ],
  "summary": {"executions": $sum, "crashes": $crash_sum}
}
END
    note "build/reports/fuzz.json"
}

# What failed, and how to see it again.
explain_failures() {
    local name file
    for name in "${failed[@]}"; do
        # An interrupted fuzzer ends with an error as well.
        [[ $interrupted == no || -n $(reproducers "$name") ]] || continue
        printf '\n%s: the end of %s\n' "$name" "build/fuzz/$name/log.txt"
        grep -E 'broke a promise|ERROR: |runtime error|SUMMARY: ' "$(log "$name")" | head -n 5 || tail -n 5 "$(log "$name")"
        while IFS= read -r file; do
            printf 'replay: %s %s\n' "${PROGRAMS#"$ROOT"/}/$name" "${file#"$ROOT"/}"
        done < <(reproducers "$name")
    done >&2
}

merge() { # NAME
    local -a flags
    read_flags "$1"
    mkdir -p "$KEPT/$1"
    "$PROGRAMS/$1" "${flags[@]}" -merge=1 "$KEPT/$1" "$(folder "$1")/corpus"
}

main() {
    case ${1:-} in
    -h | --help)
        sed -n '2,/^source/s/^# \{0,1\}//p' tools/fuzz.sh
        return
        ;;
    --merge)
        [[ $# -eq 2 ]] || fail "--merge takes the name of one fuzzer"
        build
        merge "$2"
        return
        ;;
    esac
    [[ $FUZZ_SECONDS =~ ^[1-9][0-9]*$ ]] || fail "SECONDS=$FUZZ_SECONDS: it has to be a whole number above 0"
    local -a wanted=("$@")
    [[ ${#wanted[@]} -gt 0 ]] || mapfile -t wanted < <(all_fuzzers)
    local name
    for name in "${wanted[@]}"; do
        [[ -f tests/fuzz/$name.cpp ]] || fail "there is no fuzzer $name; there are: $(all_fuzzers | tr '\n' ' ')"
    done

    build
    step "Fuzzing ${wanted[*]}, ${FUZZ_SECONDS} s each, $JOBS at a time"
    touch "$PROGRAMS/started"
    run_all "${wanted[@]}"
    step "Summary"
    report
    explain_failures
    [[ $interrupted == no ]] || fail "interrupted: the figures are of what was done until then"
    [[ ${#failed[@]} -eq 0 ]] || fail "FAILED: ${failed[*]}"
}

interrupted=no
started_at=0
failed=()
done_names=()
# The fuzzers get the signal, too, and end with their statistics.
trap 'interrupted=yes' INT
main "$@"
