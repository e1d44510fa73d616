#!/usr/bin/env bash
# The hard cases before other libraries: Embree 3, CGAL, and in Python trimesh and embreex. Prints how many each passes, and
# writes build/reports/contract-peers.json and docs/hard-cases.md. What a library fails is a result, not an error.
#
#   QUICK=1   at most 20 rays of each sweep, and the page goes beside the JSON instead of into docs/
#   PEERS     only these, e.g. PEERS='embree cgal'; the page as for QUICK=1
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly REPORTS=$ROOT/build/reports
readonly PAGE=docs/hard-cases.md

command="make contract-peers"
page=$PAGE
flags=()
if [[ ${QUICK:-} == 1 ]]; then
    command+=" QUICK=1"
    page=$REPORTS/hard-cases.md
    flags+=(--most-sweep-rays 20)
fi
if [[ -n ${PEERS:-} ]]; then
    command+=" PEERS='$PEERS'"
    page=$REPORTS/hard-cases.md
    for peer in $PEERS; do flags+=(--peer "$peer"); done
fi

# The page names the state of the sources; of itself it says nothing.
commit=$(git rev-parse --short=12 HEAD 2>/dev/null || echo unknown)
if [[ -n $(git status --porcelain -- . ":(exclude)$PAGE" 2>/dev/null) ]]; then
    commit+=" with changes"
fi

step "Building contract_peers (preset peers)"
cmake --preset peers
cmake --build --preset peers

step "Putting the libraries before the hard cases"
mkdir -p "$REPORTS"
RAYWISE_CALIBRATION=builtin build/peers/tests/contract/peers/contract_peers \
    --python "$PEERS_VENV/bin/python" --log "$REPORTS/contract-peers.log" --json "$REPORTS/contract-peers.json" \
    --page "$page" --commit "$commit" --command "$command" "${flags[@]}"
note "build/reports/contract-peers.json"
note "${page#"$ROOT/"}"
