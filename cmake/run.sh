#!/bin/sh
# Sets up what is missing, then builds and runs. Works from any folder.
#
#   sh cmake/run.sh demo [HEIGHTS.png] [-o DIR]   the demo; writes into build/demo unless told otherwise
#   sh cmake/run.sh report [HEIGHTS...] [-o DIR]  error against run time; writes into build/report unless told otherwise
#   sh cmake/run.sh test                          build everything, run the tests
#   sh cmake/run.sh clang                         the same with clang++
#   sh cmake/run.sh sanitize                      the same with address and undefined behavior sanitizers
#   sh cmake/run.sh sanitize-library              these, but of the library alone: no programs, no shaders
#   sh cmake/run.sh windows                       the tests for Windows by MinGW, run under Wine
#   sh cmake/run.sh arm                           for 64-bit Arm, run under QEMU, twice: the compiler's vectors and xsimd
#   sh cmake/run.sh web                           golden bytes and a bake in WebAssembly by Emscripten, run under Node
#   sh cmake/run.sh docs                          pages of the headers and the README; writes build/docs/html
#   sh cmake/run.sh full                          these, slow tests, more random maps, other builds, clang-tidy, all
#                                                 measurements
#
# On Debian and Ubuntu missing packages are installed, as root or with sudo. BUMPSHADOW_HEIGHT_MAPS names a folder of
# real height maps with a MANIFEST.tsv; tests that need it are skipped where it is not set. BUMPSHADOW_HLSL_COMPILERS
# names a folder with d3dcompiler_47.dll and dxcompiler.dll (default: that of "npm install webgpu" here,
# node_modules/webgpu/dist/win32-x64); with them, wine64 and g++-mingw-w64-x86-64-posix FXC and DXC are tested, too.
# CXXFLAGS=-Werror makes an error of every warning of every build that is new; without it newer compilers may warn.
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

# Debian's package wine64 puts it where no PATH leads.
has_wine() { has_tool wine64 || has_tool wine || [ -x /usr/lib/wine/wine64 ]; }

# Debian's names of the packages that are missing; what the others are for is skipped without them.
tools='' headers='' others=''
look_for_tool() { has_tool "$1" || tools="$tools $2"; }
look_for_header() { has_header "$1" || headers="$headers $2"; }

# The compilers that shader_cost asks, and what it is linked with.
look_for_cost_tools() {
    has_tool glslangValidator || others="$others glslang-tools"
    has_vulkan || others="$others mesa-vulkan-drivers"
    has_header vulkan/vulkan.h || others="$others libvulkan-dev"
}

# What compiles and runs the shaders. Tests that need it are skipped where it is missing.
look_for_shader_tools() {
    has_tool spirv-cross || others="$others spirv-cross"
    has_tool spirv-opt || others="$others spirv-tools"
    has_renderer || others="$others libgl1-mesa-dri"
    look_for_cost_tools
    has_header EGL/egl.h || others="$others libegl-dev"
    has_header GL/glcorearb.h || others="$others libgl-dev"
}

# What the roads to the library and its pages need. Tests that need it are skipped where it is missing.
look_for_consumer_tools() {
    has_tool git || others="$others git"
    has_tool pkg-config || others="$others pkg-config"
    has_tool python3 || others="$others python3"
    has_tool doxygen || others="$others doxygen"
}

# What only looks for mistakes.
look_for_check_tools() {
    has_tool run-clang-tidy || others="$others clang-tidy"
    has_tool cppcheck || others="$others cppcheck"
    has_tool valgrind || others="$others valgrind"
    has_tool doxygen || others="$others doxygen"
}

# Installs what the arguments (clang, xsimd, shaders, properties, consumers, checks, measure, plots, costs, windows, arm,
# web, docs) and every build need and do not have.
set_up() {
    tools='' headers='' others=''
    has_tool "${CXX:-c++}" || look_for_tool g++ g++
    look_for_tool cmake cmake
    has_tool ninja-build || look_for_tool ninja ninja-build
    look_for_header glm/glm.hpp libglm-dev
    look_for_header doctest/doctest.h doctest-dev
    look_for_header CLI/CLI.hpp libcli11-dev
    look_for_header nlohmann/json.hpp nlohmann-json3-dev
    has_header stb_image.h || look_for_header stb/stb_image.h libstb-dev
    for extra; do
        case $extra in
            clang) look_for_tool clang++ clang ;;
            checks) look_for_check_tools ;;
            consumers) look_for_consumer_tools ;;
            xsimd) look_for_header xsimd/xsimd.hpp libxsimd-dev ;;
            shaders) look_for_shader_tools ;;
            measure) has_tool astcenc || others="$others astcenc" ;;
            plots) has_tool gnuplot || others="$others gnuplot-nox" ;;
            costs) look_for_cost_tools ;;
            docs) look_for_tool doxygen doxygen ;;
            properties) has_header rapidcheck.h || others="$others librapidcheck-dev" ;;
            windows)
                look_for_tool x86_64-w64-mingw32-g++-posix g++-mingw-w64-x86-64-posix
                has_wine || look_for_tool wine64 wine64
                ;;
            arm)
                look_for_tool aarch64-linux-gnu-g++ g++-aarch64-linux-gnu
                look_for_tool qemu-aarch64 qemu-user
                ;;
            web)
                look_for_tool em++ emscripten
                look_for_tool node nodejs
                ;;
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
            case $tool in
                clang) tool=clang++ ;;
                g++-mingw-w64-x86-64-posix) tool=x86_64-w64-mingw32-g++-posix ;;
                wine64) if has_wine; then continue; fi ;;
                g++-aarch64-linux-gnu) tool=aarch64-linux-gnu-g++ ;;
                qemu-user) tool=qemu-aarch64 ;;
                emscripten) tool=em++ ;;
                nodejs) tool=node ;;
            esac
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

# What the other machines are compared with.
native_result() {
    (
        cd "$root"
        cmake --preset release
        cmake --build build/release --target bumpshadow_cross
        build/release/tests/bumpshadow_cross write build/native_result
    )
}

windows() {
    native_result
    (
        cd "$root"
        cmake --preset windows
        cmake --build --preset windows
        # Right before the tests: it ends by itself where it has nothing to do.
        sh cmake/toolchains/wine.sh --start || fail "Wine does not start"
        ctest --preset windows
    )
}

arm() {
    native_result
    workflow arm
    (
        cd "$root"
        cmake --preset arm -B build/arm-xsimd -DBUMPSHADOW_SIMD=xsimd -DBUMPSHADOW_BUILD_EXAMPLES=OFF
        cmake --build build/arm-xsimd --target bumpshadow_tests bumpshadow_golden bumpshadow_cross
        ctest --test-dir build/arm-xsimd --output-on-failure --no-tests=error --label-exclude slow \
            --tests-regex '^(horizon|encode|golden|measure|reference)\.|^(native|extents|factor_cube|normal_map)$'
    )
}

web() {
    native_result
    workflow web
}

# Properties of a hundred times as many random maps as the test looks at. The seed is printed, and what it found wrong
# can be had again with RC_PARAMS="seed=...".
random_properties() {
    if [ -x "$root/build/release/tests/bumpshadow_property_tests" ]; then
        RC_PARAMS="max_success=4000" "$root/build/release/tests/bumpshadow_property_tests"
    else
        say "random properties skipped: no rapidcheck here"
    fi
}

# Of all programs and tests, which need no building for it.
tidy() {
    if has_tool run-clang-tidy; then
        (
            cd "$root"
            cmake --preset clang -B build/tidy -DBUMPSHADOW_BUILD_BENCHMARKS=ON -DBUMPSHADOW_TEST_HEADERS=OFF
            run-clang-tidy -quiet -p build/tidy "^$root/(examples|tests)/"
        )
    else
        say "clang-tidy skipped: not here"
    fi
    if has_tool cppcheck; then
        (cd "$root" && cppcheck --quiet --error-exitcode=1 --enable=warning,performance,portability --std=c++20 \
            --inline-suppr --suppressions-list=cmake/cppcheck.txt -I include -I examples -I tests examples tests)
    else
        say "cppcheck skipped: not here"
    fi
}

# Each fuzz target for BUMPSHADOW_FUZZ_SECONDS, 600 if that is not set, starting from its corpus. A finding ends this
# and leaves its input in build/fuzz.
fuzz() {
    seconds=${BUMPSHADOW_FUZZ_SECONDS:-600}
    (
        cd "$root"
        cmake --preset clang -B build/fuzz -DBUMPSHADOW_FUZZ=ON -DBUMPSHADOW_TEST_HEADERS=OFF
        cmake --build build/fuzz --target fuzz_bake fuzz_read fuzz_snippets fuzz_json
        for target in bake read snippets json; do
            say "fuzzing $target for $seconds seconds"
            mkdir -p "build/fuzz/corpus/$target"
            "build/fuzz/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -timeout=60 -max_len=4000 -verbosity=0 \
                -print_final_stats=1 -artifact_prefix="build/fuzz/$target-" "build/fuzz/corpus/$target" \
                "tests/fuzz/corpus/$target"
        done
    )
}

# What runs in several threads, under the thread sanitizer.
thread_sanitizer() {
    say "thread sanitizer"
    (
        cd "$root"
        cmake --preset debug -B build/thread -DBUMPSHADOW_TEST_HEADERS=OFF -DBUMPSHADOW_BUILD_BENCHMARKS=OFF \
            -DCMAKE_CXX_COMPILER=clang++ "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -g1 -fsanitize=thread"
        cmake --build build/thread --target bumpshadow_tests
        ctest --test-dir build/thread --output-on-failure --no-tests=error \
            --tests-regex '^(horizon|encode|reference|measure|plan|faults|scratch|normal_map|factor_cube)'
    )
}

# What depends on memory that was never written, where clang's sanitizer for it can tell: it takes for unwritten what a
# standard library writes that was not built for it, as no distribution's is. So these print by printf and have none of
# its trees, streams and files, and its strings are compiled with them. Valgrind looks at the programs.
memory_sanitizer() {
    say "memory sanitizer"
    (
        cd "$root"
        flags="-O1 -g1 -fsanitize=memory -fsanitize-memory-track-origins -fno-sanitize-recover=all"
        cmake --preset debug -B build/memory -DBUMPSHADOW_BUILD_EXAMPLES=OFF -DBUMPSHADOW_TEST_HEADERS=OFF \
            -DCMAKE_CXX_COMPILER=clang++ "-DCMAKE_CXX_FLAGS_DEBUG=$flags -D_GLIBCXX_EXTERN_TEMPLATE=0"
        cmake --build build/memory --target bumpshadow_stability fuzz_bake_replay
        build/memory/tests/bumpshadow_stability
        # Without a folder: random inputs alone.
        build/memory/tests/fuzz/fuzz_bake_replay
    )
}

# The programs under valgrind, which does not know AVX-512.
under_valgrind() {
    if ! has_tool valgrind; then
        say "valgrind skipped: not here"
        return 0
    fi
    (
        cd "$root"
        case $(uname -m) in
            x86_64) flags=-march=x86-64-v3 ;;
            *) flags='' ;;
        esac
        cmake --preset release -B build/valgrind -DBUMPSHADOW_NATIVE=OFF -DBUMPSHADOW_TEST_HEADERS=OFF \
            "-DCMAKE_CXX_FLAGS=${CXXFLAGS-} -g1 $flags"
        cmake --build build/valgrind --target bake shade plan demo snippets program_test_images
        sh tests/programs/valgrind.sh "$root/build/valgrind/examples" \
            "$root/build/valgrind/tests/programs/program_test_images" "$root/build/valgrind/work"
    )
}

# run_into PROGRAM ARGUMENT...: writes into build/PROGRAM unless the arguments name a folder.
run_into() {
    program=$1
    shift
    output="$root/build/$program"
    for argument; do
        case $argument in
            -o | -o* | --output | --output=*) output='' ;;
        esac
    done
    if [ -n "$output" ]; then
        mkdir -p "$output"
        set -- "$@" -o "$output"
    fi
    "$root/build/release/examples/$program" "$@"
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
if [ -n "${BUMPSHADOW_HLSL_COMPILERS-}" ]; then
    [ -d "$BUMPSHADOW_HLSL_COMPILERS" ] ||
        fail "BUMPSHADOW_HLSL_COMPILERS names no folder: $BUMPSHADOW_HLSL_COMPILERS"
    BUMPSHADOW_HLSL_COMPILERS=$(CDPATH='' cd -- "$BUMPSHADOW_HLSL_COMPILERS" && pwd)
    export BUMPSHADOW_HLSL_COMPILERS
fi

case $command in
    demo)
        set_up
        workflow demo
        run_into demo "$@"
        ;;
    report)
        set_up measure plots costs
        workflow report
        run_into report "$@"
        ;;
    test | sanitize | sanitize-library)
        [ "${CXX-}" != clang++ ] || set_up clang
        set_up shaders properties consumers
        workflow "$command"
        note_maps
        ;;
    clang)
        set_up clang shaders properties consumers
        workflow clang
        note_maps
        ;;
    windows)
        set_up windows
        windows
        note_maps
        ;;
    arm)
        set_up arm xsimd
        arm
        note_maps
        ;;
    web)
        set_up web
        web
        ;;
    docs)
        set_up docs
        cd "$root"
        cmake --preset release -B build/docs -DBUMPSHADOW_BUILD_TESTS=OFF -DBUMPSHADOW_BUILD_EXAMPLES=OFF
        cmake --build build/docs --target bumpshadow_docs
        ;;
    full)
        set_up windows arm web clang xsimd shaders properties consumers measure plots checks
        workflow test
        (cd "$root" && ctest --test-dir build/release --output-on-failure --no-tests=error --label-regex slow)
        random_properties
        workflow clang
        workflow sanitize
        variant scalar -DBUMPSHADOW_SIMD=none
        variant xsimd -DBUMPSHADOW_SIMD=xsimd
        variant portable -DBUMPSHADOW_NATIVE=OFF
        # doctest's own switch for a build without exceptions; the programs need them.
        bare="-fno-exceptions -fno-rtti -DDOCTEST_CONFIG_NO_EXCEPTIONS_BUT_WITH_ALL_ASSERTS"
        variant bare -DBUMPSHADOW_BUILD_EXAMPLES=OFF "-DCMAKE_CXX_FLAGS=${CXXFLAGS-} $bare"
        windows
        arm
        web
        (
            cd "$root"
            cmake --preset web -B build/web-plain -DBUMPSHADOW_SIMD=none
            cmake --build build/web-plain --target bumpshadow_cross
            ctest --test-dir build/web-plain --output-on-failure --no-tests=error --tests-regex '^native$'
        )
        thread_sanitizer
        memory_sanitizer
        under_valgrind
        tidy
        fuzz
        if [ -n "${BUMPSHADOW_HEIGHT_MAPS-}" ]; then
            "$root/build/release/examples/plan" --proof --check
        else
            say "plan --proof skipped: BUMPSHADOW_HEIGHT_MAPS is not set"
        fi
        "$root/build/release/examples/benchmark"
        "$root/build/release/examples/encodings"
        # Built where Vulkan's loader and glslangValidator are.
        if [ -x "$root/build/release/examples/shader_cost" ]; then
            "$root/build/release/examples/shader_cost" --check
        else
            say "shader_cost skipped: not built"
        fi
        run_into report
        note_maps
        ;;
    *)
        sed -n '2,/^set /s/^# \{0,1\}//p' "$0"
        [ "$command" = help ] || exit 2
        ;;
esac
