#!/usr/bin/env bash
# Lays out the C and C++ sources: tools/format.sh            rewrite them
#                                 tools/format.sh --check    list what would change, exit 1 if anything
#                                 tools/format.sh --which N  print the clang-format of major version N
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# One version for everybody: each lays out a little differently, and a change should not show the tool's mood.
readonly MAJOR=14

find_clang_format() { # MAJOR VERSION
    local candidate
    for candidate in "clang-format-$1" clang-format; do
        if [[ $(version_of "$candidate" --version) == "$1".* ]]; then
            echo "$candidate"
            return 0
        fi
    done
    return 1
}

# Tracked files and new ones alike, but nothing ignored.
sources() {
    git ls-files -z --cached --others --exclude-standard -- '*.c' '*.h' '*.cpp' '*.hpp' |
        while IFS= read -r -d '' file; do
            if [[ -f $file ]]; then
                printf '%s\0' "$file"
            fi
        done
}

main() {
    if [[ ${1:-} == --which ]]; then
        find_clang_format "$2"
        return
    fi
    local clang_format
    clang_format=$(find_clang_format $MAJOR) || fail "clang-format $MAJOR is not here"
    if [[ ${1:-} == --check ]]; then
        sources | xargs -0 -r "$clang_format" --dry-run --Werror
    else
        sources | xargs -0 -r "$clang_format" -i
    fi
}

main "$@"
