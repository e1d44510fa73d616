#!/usr/bin/env bash
# tools/demo.sh            builds the C example against the installed library, as a stranger would, and runs it
# tools/demo.sh --check    only looks whether what is asked for can be had: a mistyped name should not cost
#                          the minutes of a build first
#
# From the environment: MESH (a mesh file), or SCENE (sphereflake, the default, terrain or dragon); RAYS;
# OUT (a PNG); DEMO_FLAGS, more options of raywise-demo.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

readonly PREFIX=$ROOT/build/prefix
readonly EXAMPLES=$ROOT/build/examples

build_examples() {
    step "Building the examples against the installed library"
    cmake -S examples -B "$EXAMPLES" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$PREFIX"
    cmake --build "$EXAMPLES"
}

# The release preset installs into lib; a library of another system or an older configuration may be elsewhere.
installed_library() {
    local file
    for file in "$PREFIX"/lib{,64}/libraywise.{so.1,1.dylib} "$PREFIX"/lib/*/libraywise.so.1; do
        if [[ -e $file ]]; then
            echo "$file"
            return 0
        fi
    done
    return 1
}

check_request() {
    [[ -z ${MESH:-} || -f $MESH ]] || fail "MESH=$MESH: there is no such file"
    [[ -z ${MESH:-} || -z ${SCENE:-} ]] || fail "give MESH or SCENE, not both"
    case ${SCENE:-sphereflake} in
    sphereflake | terrain) ;;
    dragon)
        [[ -s $DRAGON ]] || have npm ||
            fail "SCENE=dragon downloads the mesh with npm, which is not on this machine; install npm, or give MESH=file"
        ;;
    *) fail "SCENE=$SCENE: there are sphereflake, terrain and dragon" ;;
    esac
}

run_demo() {
    local library
    local -a arguments flags
    if [[ -n ${MESH:-} ]]; then
        arguments=(--mesh "$MESH")
    elif [[ ${SCENE:-} == dragon ]]; then
        arguments=(--mesh "$DRAGON")
    else
        arguments=(--scene "${SCENE:-sphereflake}")
    fi
    [[ -z ${RAYS:-} ]] || arguments+=(--rays "$RAYS")
    library=$(installed_library) || fail "no libraywise under build/prefix; run make build"
    arguments+=(--library "$library" --output "${OUT:-demo.png}")
    if [[ -x $PREFIX/bin/raywise-calibrate ]]; then
        arguments+=(--calibrate "$PREFIX/bin/raywise-calibrate")
    fi
    read -ra flags <<<"${DEMO_FLAGS:-}"
    arguments+=("${flags[@]}")

    step "raywise-demo ${arguments[*]}"
    "$EXAMPLES/c/raywise-demo" "${arguments[@]}"
}

check_request
if [[ ${1:-} != --check ]]; then
    if [[ ${SCENE:-} == dragon ]]; then
        fetch_dragon
    fi
    build_examples
    run_demo
fi
