#!/bin/sh
# Sets up what is missing, then builds and runs. Works from any folder.
#
#   sh cmake/run.sh demo [HEIGHTS.png] [-o DIR]   the demo; writes into build/demo unless told otherwise
#   sh cmake/run.sh test                          build everything, run the tests
#   sh cmake/run.sh clang                         the same with clang++
#   sh cmake/run.sh sanitize                      the same with address and undefined behavior sanitizers
#   sh cmake/run.sh full                          these, slow tests, other builds, clang-tidy, the benchmark
#
# On Debian and Ubuntu missing packages are installed, as root or with sudo. BUMPSHADOW_HEIGHT_MAPS names a folder of
# real height maps with a MANIFEST.tsv; tests that need it are skipped where it is not set.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)

say() { printf '%s\n' "run.sh: $*"; }
fail() { say "$*" >&2; exit 1; }

# ---- Set-up ----

has_tool() { command -v "$1" >/dev/null 2>&1; }

has_header() {
    for folder in /usr/include /usr/local/include /opt/homebrew/include; do
        if [ -e "$folder/$1" ]; then return 0; fi
    done
    return 1
}

# Mesa's software renderer, whose file was renamed in version 24.
has_renderer() {
    for file in /usr/lib/dri/swrast_dri.so /usr/lib/*/dri/swrast_dri.so /usr/lib/libgallium-* \
        /usr/lib/*/libgallium-*; do
        if [ -e "$file" ]; then return 0; fi
    done
    return 1
}

has_vulkan() {
    for file in /usr/share/vulkan/icd.d/radeon_icd*.json; do
        if [ -e "$file" ]; then return 0; fi
    done
    return 1
}

# Debian's names of the packages that are missing; what the others are for is skipped without them.
tools='' headers='' others=''
look_for_tool() { has_tool "$1" || tools="$tools $2"; }
look_for_header() { has_header "$1" || headers="$headers $2"; }

# What compiles and runs the shaders. Tests that need it are skipped where it is missing.
look_for_shader_tools() {
    has_tool glslangValidator || others="$others glslang-tools"
    has_tool spirv-cross || others="$others spirv-cross"
    has_tool spirv-opt || others="$others spirv-tools"
    has_renderer || others="$others libgl1-mesa-dri"
    # The compiler that shader_cost asks, and what that is linked with.
    has_vulkan || others="$others mesa-vulkan-drivers"
    has_header vulkan/vulkan.h || others="$others libvulkan-dev"
    has_header EGL/egl.h || others="$others libegl-dev"
    has_header GL/glcorearb.h || others="$others libgl-dev"
}

# Installs what the arguments (clang, xsimd, shaders, measure) and every build need and do not have.
set_up() {
    tools='' headers='' others=''
    has_tool "${CXX:-c++}" || look_for_tool g++ g++
    look_for_tool cmake cmake
    has_tool ninja-build || look_for_tool ninja ninja-build
    look_for_header glm/glm.hpp libglm-dev
    look_for_header doctest/doctest.h doctest-dev
    look_for_header CLI/CLI.hpp libcli11-dev
    has_header stb_image.h || look_for_header stb/stb_image.h libstb-dev
    for extra; do
        case $extra in
            clang) look_for_tool clang++ clang ;;
            xsimd) look_for_header xsimd/xsimd.hpp libxsimd-dev ;;
            shaders) look_for_shader_tools ;;
            measure) has_tool astcenc || others="$others astcenc" ;;
        esac
    done

    missing="$tools$headers$others"
    # shellcheck disable=SC2086 # lists of words
    if [ -n "$missing" ]; then
        if ! has_tool apt-get; then
            say "no apt-get here; not found in the usual places (names as on Debian):$missing"
        elif [ "$(id -u)" -eq 0 ] || has_tool sudo; then
            [ -z "$tools$headers" ] || install_packages $tools $headers
            [ -z "$others" ] || install_packages $others || say "going on without:$others"
        else
            say "neither root nor sudo here; please install:$missing"
        fi
        for tool in $tools; do
            [ "$tool" != ninja-build ] || tool=ninja
            [ "$tool" != clang ] || tool=clang++
            has_tool "$tool" || fail "cannot go on without $tool"
        done
        # CMake knows more places for headers than the usual ones, so it has the last word about those.
    fi

    version=$(cmake --version | sed -n '1s/.*version \([0-9]*\)\.\([0-9]*\).*/\1 \2/p')
    [ "${version% *}" -gt 3 ] || [ "${version#* }" -ge 25 ] ||
        fail "the presets need CMake 3.25 or newer, found ${version% *}.${version#* }"
}

as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi; }

install_packages() {
    say "installing with apt-get: $*"
    as_root apt-get -qq update &&
        as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends "$@" </dev/null
}

# ---- Builds ----

workflow() { (cd "$root" && cmake --workflow --preset "$1"); }

note_maps() {
    if [ -z "${BUMPSHADOW_HEIGHT_MAPS-}" ]; then
        say "tests on real height maps were skipped: BUMPSHADOW_HEIGHT_MAPS is not set"
    fi
}

# variant NAME CMAKE_ARGUMENT...: a release build with other settings in build/NAME, tested.
variant() {
    name=$1
    shift
    say "variant $name"
    (
        cd "$root"
        cmake --preset release -B "build/$name" "$@"
        cmake --build "build/$name"
        ctest --test-dir "build/$name" --output-on-failure --no-tests=error --label-exclude slow
    )
}

tidy() {
    if has_tool run-clang-tidy; then
        (cd "$root" && run-clang-tidy -quiet -p build/clang "^$root/(examples|tests)/")
    else
        say "clang-tidy skipped: not here"
    fi
}

run_demo() {
    output="$root/build/demo"
    for argument; do
        case $argument in
            -o | -o* | --output | --output=*) output='' ;;
        esac
    done
    if [ -n "$output" ]; then
        mkdir -p "$output"
        set -- "$@" -o "$output"
    fi
    "$root/build/release/examples/demo" "$@"
}

command=${1-}
[ $# -eq 0 ] || shift

cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
export CTEST_PARALLEL_LEVEL="${CTEST_PARALLEL_LEVEL:-$cores}"
if [ -n "${BUMPSHADOW_HEIGHT_MAPS-}" ]; then
    [ -d "$BUMPSHADOW_HEIGHT_MAPS" ] || fail "BUMPSHADOW_HEIGHT_MAPS names no folder: $BUMPSHADOW_HEIGHT_MAPS"
    BUMPSHADOW_HEIGHT_MAPS=$(CDPATH='' cd -- "$BUMPSHADOW_HEIGHT_MAPS" && pwd)  # tests run in other folders
    export BUMPSHADOW_HEIGHT_MAPS
fi

case $command in
    demo)
        set_up
        workflow demo
        run_demo "$@"
        ;;
    test | sanitize)
        set_up shaders
        workflow "$command"
        note_maps
        ;;
    clang)
        set_up clang shaders
        workflow clang
        note_maps
        ;;
    full)
        set_up clang xsimd shaders measure
        workflow test
        (cd "$root" && ctest --test-dir build/release --output-on-failure --no-tests=error --label-regex slow)
        workflow clang
        workflow sanitize
        variant scalar -DBUMPSHADOW_SIMD=none
        variant xsimd -DBUMPSHADOW_SIMD=xsimd
        variant portable -DBUMPSHADOW_NATIVE=OFF
        # doctest's own switch for a build without exceptions; the programs need them.
        bare="-fno-exceptions -fno-rtti -DDOCTEST_CONFIG_NO_EXCEPTIONS_BUT_WITH_ALL_ASSERTS"
        variant bare -DBUMPSHADOW_BUILD_EXAMPLES=OFF "-DCMAKE_CXX_FLAGS=$bare"
        tidy
        "$root/build/release/examples/benchmark"
        "$root/build/release/examples/encodings"
        # Built where Vulkan's loader and glslangValidator are.
        if [ -x "$root/build/release/examples/shader_cost" ]; then
            "$root/build/release/examples/shader_cost" --check
        else
            say "shader_cost skipped: not built"
        fi
        note_maps
        ;;
    *)
        sed -n '2,/^set /s/^# \{0,1\}//p' "$0"
        [ "$command" = help ] || exit 2
        ;;
esac
