#!/usr/bin/env bash
# The correctness contract at the desk: the hard cases, 10^9 comparisons of answers and 10^8 rays at edges and vertices.
# Prints a table of each and writes build/reports/contract.json. Fails on a case that is not passed, a disagreement, a
# leak, or when less was done than was asked for. Ctrl-C ends it early with a report of what was done, marked incomplete.
#
# From the environment: QUICK=1, the short form (10^7 and 10^6); SEED, of all random rays (default 1);
# CONTRACT_FLAGS, more options of contract_sweep.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly PROGRAMS=build/dev/tests/contract
readonly REPORT=build/reports/contract.json
readonly PARTS=build/reports/contract-parts

read -ra flags <<<"${CONTRACT_FLAGS:-}"
command="make contract"
sweep=(--seed "${SEED:-1}")
if [[ ${QUICK:-0} != 0 && -n ${QUICK:-} ]]; then
    sweep+=(--comparisons 1e7 --edge-rays 1e6 --sizes "300,3000" --most-triangles 20000)
    command+=" QUICK=1"
fi
[[ -z ${SEED:-} ]] || command+=" SEED=$SEED"
[[ ${#flags[@]} -eq 0 ]] || command+=" CONTRACT_FLAGS='${flags[*]}'"

commit() { git describe --always --dirty --abbrev=12 --exclude='*' 2>/dev/null || echo unknown; }

step "Building"
cmake --preset dev >/dev/null
cmake --build --preset dev --target contract_sweep contract_cases contract_report

rm -rf "$PARTS" "$REPORT"
mkdir -p "$PARTS"
failed=()
# The programs end by themselves on an interrupt; what they did is still to be put together.
trap 'failed+=("interrupted")' INT

step "Hard cases"
"$PROGRAMS/contract_cases" --json "$PARTS/cases.json" || failed+=("hard cases")

if [[ " ${failed[*]} " != *" interrupted "* ]]; then
    step "Sweeps: contract_sweep ${sweep[*]} ${flags[*]}"
    "$PROGRAMS/contract_sweep" "${sweep[@]}" "${flags[@]}" --json "$PARTS/sweep.json" || failed+=("sweeps")
fi

step "Report: $REPORT"
shopt -s nullglob
parts=("$PARTS"/*.json)
[[ ${#parts[@]} -gt 0 ]] || fail "nothing was finished, so there is no report"
"$PROGRAMS/contract_report" --target contract --commit "$(commit)" --command "$command" --output "$REPORT" "${parts[@]}"
[[ ${#failed[@]} -eq 0 ]] || fail "the contract is not kept, or not all was tried: ${failed[*]}"
