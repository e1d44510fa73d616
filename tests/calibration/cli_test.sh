#!/usr/bin/env bash
# Smoke test of raywise-calibrate: every command, its exit codes and what it leaves behind.
# usage: cli_test.sh PROGRAM
set -uo pipefail

readonly PROGRAM=$1
FOLDER=$(mktemp -d)
readonly FOLDER
trap 'rm -rf "$FOLDER"' EXIT
export XDG_CACHE_HOME=$FOLDER/cache
unset RAYWISE_CALIBRATION
failures=0

fail() {
    echo "FAILED: $*"
    sed 's/^/    stdout: /' "$FOLDER/out"
    sed 's/^/    stderr: /' "$FOLDER/err"
    failures=$((failures + 1))
}

# expect CODE ARGUMENTS...: runs the program.
expect() {
    local code=$1 actual=0
    shift
    "$PROGRAM" "$@" >"$FOLDER/out" 2>"$FOLDER/err" </dev/null || actual=$?
    [[ $actual == "$code" ]] || fail "raywise-calibrate $* ended with $actual, expected $code"
}
printed() { grep -qF -- "$1" "$FOLDER/out" || fail "expected on standard output: $1"; }
complained() { grep -qF -- "$1" "$FOLDER/err" || fail "expected on standard error: $1"; }
narrow() { awk 'length > 100 { exit 1 }' "$FOLDER/out" || fail "a line of more than 100 columns"; }

# Help
expect 0 --help
printed "Exit codes"
narrow
for command in measure show check explain; do
    expect 0 "$command" --help
    printed "Usage: raywise-calibrate $command"
    narrow
done
expect 0 --version
printed "libraywise"

# Wrong command lines
expect 2 nonsense
expect 2 --nonsense
expect 2 measure --quick --full
expect 2 measure --system --output "$FOLDER/x.json"
expect 2 measure --time-limit soon
expect 2 measure --threads 0
expect 2 explain
expect 2 explain "$FOLDER/mesh.off" --rays 0
expect 2 explain "$FOLDER/mesh.off" --rays -5
expect 2 explain "$FOLDER/mesh.off" --rays 10 --kind sideways
expect 2 show one two

# Without a profile
expect 0 show
printed "generic constants"
narrow
expect 0 show --json
printed "raywise-profile/2"
expect 1 check
printed "no valid profile"
expect 1 check "$FOLDER/missing.json"
printed "missing.json"
expect 1 show "$FOLDER/missing.json"
complained "missing.json"

# A measurement is saved, read back and found
expect 0 measure --quick --force --time-limit 60 --output "$FOLDER/profile.json"
printed "Saved $FOLDER/profile.json"
expect 0 show "$FOLDER/profile.json"
printed "projected_bvh"
printed "bvh_quality"
printed "bvh_morton"
narrow
expect 0 show "$FOLDER/profile.json" --json
cmp -s "$FOLDER/out" "$FOLDER/profile.json" || fail "show --json differs from the file"
expect 0 check "$FOLDER/profile.json"
printed "valid: $FOLDER/profile.json"
RAYWISE_CALIBRATION=$FOLDER/profile.json expect 0 check
[[ $(find "$FOLDER" -name '*.json*' | wc -l) == 1 ]] || fail "something was left behind: $(find "$FOLDER" -name '*.json*')"

# Where the library looks for it
KEY=$(RAYWISE_CALIBRATION=builtin "$PROGRAM" check | sed -n 's/.*machine (\([^)]*\)).*/\1/p')
mkdir -p "$XDG_CACHE_HOME/raywise"
cp "$FOLDER/profile.json" "$XDG_CACHE_HOME/raywise/$KEY.json"
expect 0 check
printed "valid: $XDG_CACHE_HOME/raywise/$KEY.json"

# Broken and foreign profiles
head -c 1000 "$FOLDER/profile.json" >"$FOLDER/broken.json"
expect 1 check "$FOLDER/broken.json"
printed "broken.json"
expect 1 show "$FOLDER/broken.json"
complained "broken.json"
sed 's/"vendor": "[^"]*"/"vendor": "Other"/' "$FOLDER/profile.json" >"$FOLDER/foreign.json"
expect 1 check "$FOLDER/foreign.json"
printed 'machine.vendor: the profile has "Other"'
expect 0 show "$FOLDER/foreign.json"
printed "Not valid here"
RAYWISE_CALIBRATION=$FOLDER/broken.json expect 0 check # the user's own is next
printed "passed over: $FOLDER/broken.json"
printed "valid: $XDG_CACHE_HOME/raywise/$KEY.json"
RAYWISE_CALIBRATION=$FOLDER/broken.json expect 0 show
printed "profile     $XDG_CACHE_HOME/raywise/$KEY.json (user)"
printed "passed over $FOLDER/broken.json"
! grep -q generic "$FOLDER/out" || fail "generic constants are named although a file is used"
sed 's/"instruction_set": "[^"]*"/"instruction_set": "OTHER"/' "$FOLDER/profile.json" >"$FOLDER/level.json"
expect 1 check "$FOLDER/level.json"
printed 'machine.instruction_set: the profile has "OTHER"'
printed "generic constants are used"

# Places that cannot be written
expect 1 measure --quick --force --time-limit 60 --output /dev/null
expect 1 measure --quick --time-limit 0.1 --output "$FOLDER/hurried.json"
complained "nothing was saved"
[[ ! -e $FOLDER/hurried.json ]] || fail "a profile of one scene was saved"

# Explain
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n' >"$FOLDER/mesh.off"
expect 0 explain "$FOLDER/mesh.off" --rays 1000
printed "linear_scan"
narrow
expect 0 explain "$FOLDER/mesh.off" --rays unknown --kind shadow --json
printed '"'
expect 0 explain "$FOLDER/mesh.off" # a row for each of 1, 10 ... 10^8 rays
narrow
for rays in 1 10 100 1,000 10,000 100,000 1,000,000 10,000,000 100,000,000; do
    grep -qE "^ *$rays +[a-z_]+ +[0-9.]+ [num]?s " "$FOLDER/out" || fail "no row for $rays rays"
done
[[ $(wc -l <"$FOLDER/out") == 11 ]] || fail "the table has other rows"
expect 0 explain "$FOLDER/mesh.off" --kind camera --json
printed '"ray_kind": "camera"'
[[ $(grep -c '"predicted_total_ns"' "$FOLDER/out") == 9 ]] || fail "the JSON has not nine choices"
# The rows are what explain says of each number by itself.
structure=$("$PROGRAM" explain "$FOLDER/mesh.off" --rays 1000 | sed -n 's/^> \([a-z_]*\) .*/\1/p')
expect 0 explain "$FOLDER/mesh.off"
grep -qE "^ *1,000 +$structure " "$FOLDER/out" || fail "the table chooses otherwise than $structure for 1,000 rays"
expect 1 explain "$FOLDER/missing.off" --rays 10
complained "missing.off"

if ((failures > 0)); then
    echo "$failures failures"
    exit 1
fi
echo "all well"
