#!/usr/bin/env bash
# check_contraction.sh OBJDUMP CONTROL OBJECT...
#
# Fails when one of the object files holds a fused multiply-add of float64, in which hits are decided; tests in float32 only cull, and
# ask for fused ones. CONTROL is one that must hold some: without it, a disassembler
# that does not know the instruction set, or a compiler that would not have fused anything, would pass.
set -euo pipefail

[[ $# -ge 3 && $1 != --help ]] || {
    sed -n '2,6s/^# \?//p' "${BASH_SOURCE[0]}"
    exit 2
}
objdump=$1
control=$2
shift 2

# OBJECT...: lines "file: function: instruction" of all of them, x86-64's and AArch64's.
fused() {
    "$objdump" -d -C --no-show-raw-insn "$@" | awk '
        / file format /   { file = $1; sub(/.*\//, "", file) }
        /^[0-9a-f]+ <.*>:$/ { name = $0; sub(/^[0-9a-f]+ </, "", name); sub(/>:$/, "", name); next }
        $2 ~ /^vfn?m(add|sub|addsub|subadd)[0-9]+[sp]d$/ || ($2 ~ /^(fn?m(add|sub)|fml[as])$/ && $3 ~ /^(d|v[0-9]+\.2d)/) { print file " " name ": " $2 }'
}

[[ -n $(fused "$control") ]] || {
    echo "no fused multiply-add found in $control, which has to hold one: this check cannot see them" >&2
    exit 1
}
found=$(fused "$@")
if [[ -n $found ]]; then
    echo "fused multiply-adds in code that decides a hit:" >&2
    sort <<<"$found" | uniq -c >&2
    exit 1
fi
echo "no fused multiply-add in $# object files"
