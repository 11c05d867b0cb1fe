# sh valgrind.sh PROGRAMS_FOLDER IMAGES WORK_DIR
# The programs under valgrind, which finds what depends on memory that was never written. For a build without
# instructions that valgrind does not know, such as AVX-512. Takes minutes: run.sh full runs it.
# shellcheck disable=SC2086 # lists of words
# shellcheck source=tests/programs/check.sh
. "$(dirname "$0")/check.sh"
programs=$program

sound() {
    name=$1
    shift
    valgrind -q --error-exitcode=9 --track-origins=yes "$programs/$name" "$@" >stdout 2>stderr
    code=$?
    [ $code -eq 0 ] || fail "exit code $code: $name $*: $(head -40 stderr)"
}

block='in/block.png --height-scale 4 --threads 2'
holes="$block --no-data 0"  # all but the block
open='in/block.png --height-scale 4 --edge open --no-data 255'
for map in "$block" "$holes" "$open"; do
    for method in exact cascade sweep sweep-classic neighborhood; do
        bearings=5
        [ $method = neighborhood ] && bearings=8
        sound bake $map -o out/a.f32 --method $method --bearings $bearings
    done
    sound bake $map -o out/a.f32 --steps 40 --radius 9 --bearings 3
    sound bake $map -o out/a.f32 --curvature 0.01 0.02 --bearings 3
    for encoding in tangent 'tangent --bits bc4' 'tangent --bits 16' 'tangent --array --mips' \
        'tangent --fit least-angle' layers 'layers --overlapping' sine 'sine --factor-cube' 'sine --published' fourier \
        'fourier --coefficients 9 --square-root' ssbump 'ssbump --occlusion directional' emboss; do
        sound bake $map -o out/a.raw --encoding $encoding
    done
    sound bake $map -o out/a.dds --encoding tangent --reduce 2
    sound shade $map -o out/a.png --encoding tangent --light 30 20
    sound shade $map -o out/a.png --encoding ssbump
    sound shade $map -o out/a.png --encoding traced
done
# Every kind of scene, and what each makes of its map.
for scene in '{}' '{"lights": [{"azimuth": 30, "elevation": 20}]}' '{"positions": [[9, 9, 5]], "bytes": 2}' \
    '{"arc": {"azimuth": [0, 180], "elevation": [5, 60]}, "texels_per_pixel": 3, "normals": false}'; do
    echo "$scene" >scene.json
    sound plan scene.json in/block.png --height-scale 4 --json out/plan.json
done
sound plan scene.json in/block.png --height-scale 4 --measure
sound demo in/block.png -o out/demo
sound snippets
sound snippets --list
sound snippets --decoder fourier-9 --dialect hlsl
finish
