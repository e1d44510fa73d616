#!/usr/bin/env bash
# Gets a machine ready: tools/setup.sh [--check] GOAL...   with goals from tools/packages.txt, or `all`.
#
# Looks for what the goals need and installs only what is not there: Debian packages with apt-get (as root
# or through sudo), the Python packages into build/venv. Where nothing is missing it asks for no rights and
# no network. Where it may not install it lists what is missing, with the command to run, and exits with 3.
#
#   --check                 look and list, install nothing
#   RAYWISE_SKIP_PROBES=1   trust that all is there (for package managers that hide headers from the compiler)
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly EXIT_MISSING=3
readonly TABLE=$ROOT/tools/packages.txt
readonly REQUIREMENTS=$ROOT/bindings/python/requirements-test.txt
readonly PEERS_REQUIREMENTS=$ROOT/tests/contract/peers/requirements.txt
readonly BENCH_REQUIREMENTS=$ROOT/tests/bench/requirements.txt
readonly BENCH_PYTHON_REQUIREMENTS=$ROOT/tests/bench/python/requirements.txt
readonly OPEN3D_REQUIREMENTS=$ROOT/tests/bench/python/requirements-open3d.txt
readonly LOGS=$ROOT/build/setup

check_only=no
goals=()
missing_packages=()
missing_lines=()

# --- probes: each answers whether one thing is there ------------------------------------------------

probe_command() { # NAME [OLDEST VERSION]
    have "$1" || return 1
    [[ -z ${2:-} ]] && return 0
    local found
    found=$(version_of "$1" --version)
    [[ -n $found ]] && at_least "$found" "$2"
}

cxx() { echo "${CXX:-$(command -v c++ || command -v g++ || command -v clang++ || true)}"; }

compiles() { # reads a C++ source; CXX may carry flags, hence the unquoted use
    local compiler
    compiler=$(cxx)
    # shellcheck disable=SC2086
    [[ -n $compiler ]] && $compiler -std=c++17 -x c++ -fsyntax-only - >/dev/null 2>&1
}

# A compiler without its standard library's headers is as good as none.
probe_cxx17() { compiles <<<$'#include <cstdint>\n#include <optional>\nstd::optional<int> x;'; }

# Looking at the usual folders first costs no compiler run, and gives a true answer before there is a
# compiler at all, so that the list of what is missing is right on a bare machine.
probe_header() {
    local folder
    local -a prefixes
    IFS=: read -ra prefixes <<<"${CMAKE_PREFIX_PATH:-}:/usr/local:/usr"
    for folder in "${prefixes[@]}"; do
        [[ -n $folder && -e $folder/include/$1 ]] && return 0
    done
    for folder in /usr/include/*-linux-gnu*; do
        [[ -e $folder/$1 ]] && return 0
    done
    compiles <<<"#include <$1>"
}

probe_certificates() {
    local file
    for file in "${SSL_CERT_FILE:-}" /etc/ssl/certs/ca-certificates.crt /etc/pki/tls/certs/ca-bundle.crt \
        /etc/ssl/ca-bundle.pem /etc/ssl/cert.pem; do
        [[ -n $file && -s $file ]] && return 0
    done
    return 1
}

# What the system's loader finds.
probe_shared_library() { # SONAMES...
    local known name
    known=$(PATH=$PATH:/usr/sbin:/sbin ldconfig -p 2>/dev/null) || return 1
    for name in "$@"; do
        [[ $known == *"$name "* ]] || return 1
    done
}

# What localedef makes locales from.
probe_locale_source() { # NAMES...
    local name
    have localedef && [[ -e /usr/share/i18n/charmaps/UTF-8.gz || -e /usr/share/i18n/charmaps/UTF-8 ]] || return 1
    for name in "$@"; do
        [[ -e /usr/share/i18n/locales/$name ]] || return 1
    done
}

probe_libclang() {
    local folder
    for folder in "${LIBCLANG_PATH:-}" /usr/lib/llvm*/lib /usr/lib/*-linux-gnu /usr/lib64 /usr/lib /usr/local/lib; do
        [[ -n $folder ]] && compgen -G "$folder/libclang[.-]*so*" >/dev/null && return 0
    done
    return 1
}

# libFuzzer comes beside the compiler, in a package of its own.
probe_fuzzer_runtime() { # MAJOR VERSION
    "clang++-$1" -fsanitize=fuzzer,address,undefined -x c++ - -o /dev/null >/dev/null 2>&1 <<<'
        #include <fuzzer/FuzzedDataProvider.h>
        extern "C" int LLVMFuzzerTestOneInput(const unsigned char *, unsigned long) { return 0; }'
}

# Where a cargo and rustc of the wanted version are: on PATH, where rustup puts them, or Debian's.
find_rust() { # OLDEST VERSION
    local folder
    local -a folders
    IFS=: read -ra folders <<<"$PATH:${CARGO_HOME:-${HOME:-}/.cargo}/bin:/usr/bin"
    for folder in "${folders[@]}"; do
        [[ $folder != "$TOOLCHAIN" ]] || continue
        [[ -x $folder/cargo && -x $folder/rustc ]] || continue
        # Asked through PATH as the build does it: cargo calls the first rustc it finds there.
        if at_least "$(version_of env "PATH=$folder:$PATH" cargo --version)" "$1" &&
            at_least "$(version_of env "PATH=$folder:$PATH" rustc --version)" "$1"; then
            echo "$folder"
            return 0
        fi
    done
    return 1
}

probe_rust() { find_rust "$1" >/dev/null; }

find_python() { # OLDEST VERSION
    local candidate
    for candidate in ${PYTHON:+"$PYTHON"} python3 /usr/bin/python3 python3.13 python3.12 python3.11 python3.10 python3.9; do
        if have "$candidate" && at_least "$(version_of "$candidate" --version)" "$1"; then
            command -v "$candidate"
            return 0
        fi
    done
    return 1
}

probe_python() { find_python "$1" >/dev/null; }

# Debian splits venv in two and leaves ensurepip in a package of its own: ask for both.
probe_python_venv() {
    local python
    python=$(find_python 3.9) && "$python" -c 'import venv, ensurepip' 2>/dev/null
}

probe_clang_format() { # MAJOR VERSION
    [[ -n $("$ROOT/tools/format.sh" --which "$1" 2>/dev/null) ]]
}

probe() { # a probe cell of the table
    local -a words
    read -ra words <<<"$1"
    "probe_${words[0]//-/_}" "${words[@]:1}"
}

# --- walking the table ------------------------------------------------------------------------------

trim() {
    local -a words
    read -ra words <<<"$1"
    echo "${words[*]}"
}

wanted() { # a goals cell of the table: does it name one of the goals asked for?
    local goal
    for goal in "${goals[@]}"; do
        [[ $goal == all || " $1 " == *" $goal "* ]] && return 0
    done
    return 1
}

look() { # fills missing_packages and missing_lines
    local row_goals packages probe_cell purpose
    missing_packages=()
    missing_lines=()
    while IFS='|' read -r row_goals packages probe_cell purpose; do
        wanted "$(trim "$row_goals")" || continue
        packages=$(trim "$packages")
        if ! probe "$(trim "$probe_cell")"; then
            read -ra words <<<"$packages"
            missing_packages+=("${words[@]}")
            missing_lines+=("$(printf '%-22s %s' "$packages" "$(trim "$purpose")")")
        fi
    done < <(grep -vE '^[[:space:]]*(#|$)' "$TABLE")
}

check_goals() {
    local goal
    [[ ${#goals[@]} -gt 0 ]] || fail "which goal? One of: $(known_goals) all"
    for goal in "${goals[@]}"; do
        [[ " $(known_goals) all " == *" $goal "* ]] || fail "unknown goal '$goal'; there are: $(known_goals) all"
    done
}

known_goals() {
    trim "$(grep -vE '^[[:space:]]*(#|$)' "$TABLE" | cut -d'|' -f1 | tr -s ' ' '\n' | sort -u | tr '\n' ' ')"
}

# --- installing -------------------------------------------------------------------------------------

apt_command() {
    local sudo="sudo "
    [[ $EUID -ne 0 ]] || sudo=""
    echo "${sudo}apt-get update && ${sudo}apt-get install --no-install-recommends ${missing_packages[*]}"
}

give_up() { # REASON
    {
        printf '\nraywise: %s Missing for %s:\n\n' "$1" "${goals[*]}"
        printf '    %s\n' "${missing_lines[@]}"
        printf '\nOn Debian 12, install them with\n\n    %s\n\n' "$(apt_command)"
        printf 'and run the same command again. Elsewhere, install what these packages hold.\n'
        rust_advice
    } >&2
    exit "$EXIT_MISSING"
}

# Debian's cargo-web stands in the place of cargo and of rustup's package; apt-get is told to remove nothing.
rust_advice() {
    local found
    [[ " ${missing_packages[*]} " == *" cargo-web "* ]] || return 0
    found=$(version_of cargo --version)
    [[ -n $found ]] || return 0
    printf "The cargo that is here is %s. Debian's cargo, rustc and rustup packages have to go before\n" "$found"
    printf 'cargo-web and rustc-web can come; any newer toolchain found first on PATH does as well.\n'
}

# root: we are; sudo: without a password, or with a terminal where one can be typed.
way_to_root() {
    if [[ $EUID -eq 0 ]]; then
        echo root
    elif have sudo && { sudo -n true 2>/dev/null || [[ -t 0 && -t 2 && -z ${CI:-} ]]; }; then
        echo sudo
    fi
}

# apt-get says hundreds of lines; a person wants the size, the pace and what went wrong. The rest is kept.
condense_apt() {
    awk '
        /^(E|W|Err|dpkg)[: ]/      { print "    " $0 }
        /newly installed/          { total = $3 + 0; print "    " $0 }
        /^(Need to get|Fetched) /  { print "    " $0 }
        /^Setting up /             { if (++done % 25 == 0 || done == total) print "    set up " done " of " total; fflush() }
    '
}

run_apt() { # apt-get's arguments
    local -a as_root=()
    [[ $EUID -eq 0 ]] || as_root=(sudo)
    # A machine that has just booted may be updating itself: wait for the lock instead of failing.
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 apt-get -q \
        -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "$@" </dev/null 2>&1 | tee -a "$LOGS/apt.log" | condense_apt
}

install_packages() {
    have apt-get || give_up "there is no apt-get on this machine."
    [[ -n $(way_to_root) ]] || give_up "packages can only be installed by root or with sudo."

    step "Installing Debian packages: ${missing_packages[*]}"
    : >"$LOGS/apt.log"
    # Some other source on the machine may be unreachable while Debian's is fine: let the install decide.
    run_apt update || note "apt-get update reported errors; going on with the package lists that are here"
    # --no-remove: making room by taking a person's packages away is not for a build script to decide.
    if ! run_apt install --yes --no-install-recommends --no-remove "${missing_packages[@]}"; then
        printf '\n    The last lines of build/setup/apt.log:\n' >&2
        tail -n 15 "$LOGS/apt.log" | sed 's/^/    /' >&2
        give_up "apt-get could not install them."
    fi

    hash -r
    look
    [[ ${#missing_packages[@]} -eq 0 ]] || give_up "the packages are installed, yet something is not found or too old."
}

system_packages() {
    [[ ${RAYWISE_SKIP_PROBES:-} != 1 ]] || return 0
    look
    if [[ ${#missing_packages[@]} -eq 0 ]]; then
        note "system packages for ${goals[*]}: all here"
    elif [[ $check_only == yes ]]; then
        give_up "this was only a look."
    else
        mkdir -p "$LOGS"
        install_packages
    fi
}

# --- Rust and Python --------------------------------------------------------------------------------

needs() { # GOAL...: is one of them asked for?
    wanted "$*"
}

# When the good toolchain is not the first on PATH, links in build/toolchain make it the first.
choose_rust() { # OLDEST VERSION
    local folder tool
    folder=$(find_rust "$1") || fail "no cargo and rustc of version $1 or newer on PATH"
    rm -rf "$TOOLCHAIN"
    if [[ $(command -v cargo) != "$folder/cargo" || $(command -v rustc) != "$folder/rustc" ]]; then
        mkdir -p "$TOOLCHAIN"
        for tool in cargo rustc rustdoc; do
            [[ -x $folder/$tool ]] && ln -s "$folder/$tool" "$TOOLCHAIN/$tool"
        done
    fi
    hash -r
    note "Rust: $(cargo --version), from $folder"
}

# Now, and not in the middle of a test: a registry that cannot be reached should fail here, with its own words.
fetch_crates() {
    local manifest
    for manifest in bindings/*/Cargo.toml; do
        [[ -f $manifest ]] || continue
        note "Rust crates of ${manifest%/Cargo.toml}"
        cargo fetch --quiet --manifest-path "$manifest" </dev/null
    done
}

# What a virtual environment was made from. Equal means that there is nothing to do.
venv_recipe() { # PYTHON FOLDER REQUIREMENTS
    echo "$2"
    "$1" --version
    cat "$3"
}

condense_pip() {
    # --line-buffered: shown as it happens, also in a pipeline's log.
    grep --line-buffered -E '^ *(Downloading|Successfully|ERROR|WARNING|error)' | sed -u 's/^ */    /' || true
}

run_pip() { # FOLDER REQUIREMENTS
    "$1/bin/python" -m pip install --no-input --disable-pip-version-check --progress-bar off -r "$2" \
        </dev/null 2>&1 | tee "$LOGS/pip.log" | condense_pip
}

# More packages, which there are not for every Python: what cannot be had is asked for again the next time.
add_to_venv() { # FOLDER REQUIREMENTS WHAT
    local folder=$1 requirements=$2 what=$3
    if venv_recipe "$folder/bin/python" "$folder" "$requirements" | cmp -s - "$folder/added-from.txt"; then
        return 0
    fi
    step "Installing $what into ${folder#"$ROOT/"}"
    mkdir -p "$LOGS"
    if run_pip "$folder" "$requirements"; then
        venv_recipe "$folder/bin/python" "$folder" "$requirements" >"$folder/added-from.txt"
    else
        note "$what is left out: pip has none for $("$folder/bin/python" --version) here; what it said is in build/setup/pip.log"
    fi
}

make_venv() { # FOLDER REQUIREMENTS
    local folder=$1 requirements=$2 name=${1#"$ROOT/"} python
    python=$(find_python 3.9) || fail "no python3 of version 3.9 or newer on PATH"
    [[ -f $requirements ]] || fail "${requirements#"$ROOT/"} is missing"
    if [[ -x $folder/bin/python ]] && venv_recipe "$python" "$folder" "$requirements" | cmp -s - "$folder/made-from.txt"; then
        note "Python: $("$folder/bin/python" --version), packages in $name up to date"
        return 0
    fi

    step "Installing Python packages into $name ($("$python" --version))"
    mkdir -p "$LOGS"
    rm -rf "$folder"
    "$python" -m venv "$folder"
    run_pip "$folder" "$requirements" || fail "pip failed; all it said is in build/setup/pip.log"
    # Last, so that an interrupted run is not taken for a finished one.
    venv_recipe "$python" "$folder" "$requirements" >"$folder/made-from.txt"
}

main() {
    local argument
    for argument in "$@"; do
        case $argument in
        --check) check_only=yes ;;
        -*) fail "unknown option $argument" ;;
        *) goals+=("$argument") ;;
        esac
    done
    check_goals

    step "Setting up for: ${goals[*]}"
    system_packages
    [[ $check_only == no ]] || return 0
    if needs test bindings; then
        choose_rust 1.74
        make_venv "$VENV" "$REQUIREMENTS"
    fi
    if needs bench-rust; then
        choose_rust 1.90
    fi
    if needs peers; then
        make_venv "$PEERS_VENV" "$PEERS_REQUIREMENTS"
    fi
    if needs bench; then
        make_venv "$BENCH_VENV" "$BENCH_REQUIREMENTS"
    fi
    if needs bench-python; then
        make_venv "$BENCH_PYTHON_VENV" "$BENCH_PYTHON_REQUIREMENTS"
        add_to_venv "$BENCH_PYTHON_VENV" "$OPEN3D_REQUIREMENTS" Open3D
    fi
    if needs test; then
        fetch_crates
    fi
}

main "$@"
