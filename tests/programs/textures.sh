# sh textures.sh BAKE IMAGES WORK_DIR
# bake --encoding: bytes worked by hand, headers after their specification, and other programs that read the files.
# shellcheck disable=SC2086,SC2089,SC2090 # lists of words
# shellcheck source=tests/programs/check.sh
. "$(dirname "$0")/check.sh"

hex() { od -An -v -tx1 "$@" | tr -d ' \n'; }
# holds FILE SKIP WANTED: the bytes from SKIP on, in hexadecimal
holds() {
    found=$(tail -c +$(($2 + 1)) "$1" | hex)
    [ "$found" = "$3" ] || fail "$1 holds $found instead of $3"
}
# words FILE SKIP COUNT WANTED...: little-endian 32-bit numbers
words() {
    file=$1 skip=$2 count=$3
    shift 3
    found=$(od -An -v -tu4 -j "$skip" -N $((4 * count)) "$file" | tr -s ' \n' ' ' | sed 's/^ //; s/ $//')
    [ "$found" = "$*" ] || fail "$file holds $found at $skip instead of $*"
}

# ---- A step of height 4: horizons of slope 1, 4/3, 2, 4 in front of it, over a max_slope of 4 ----

exact='--method exact --height-scale 4 --fit point'
step="$exact --edge clamp --max-slope 4"
volume=405580ff00000000
none=0000000000000000

run in/gray8.png -o out/a.raw $step --encoding tangent --bearings 2
holds out/a.raw 0 $volume$none
wanted='{"width":8,"height":1,"method":"exact","steps":12,"encoding":"tangent","bearings":2,"phase":0,'
wanted=$wanted'"bearing_function":"cubic","stored":"slope","max_slope":4,"coordinate_offset":0.25,"textures":['
wanted=$wanted'{"format":"r8","kind":"volume","width":8,"height":1,"depth":2,"layers":1,"mips":1,"offset":0,"bytes":16}],'
wanted=$wanted'"clamped":0,"steepest":4,"directions":2,"bake_seconds":N,"pack_seconds":N}'
json=$(sed -E 's/(_seconds":)[0-9.]+/\1N/g' stdout)
[ "$json" = "$wanted" ] || fail "JSON: $(cat stdout)"

# Microsoft, "DDS file layout": magic, 124, capabilities (height, width, format, pitch, depth), height, width, pitch, depth.
run in/gray8.png -o out/a.dds $step --encoding tangent --bearings 2
[ "$(head -c 4 out/a.dds)" = 'DDS ' ] || fail "magic: $(head -c 4 out/a.dds | hex)"
words out/a.dds 4 7 124 $((0x80100f)) 1 8 8 2 0
words out/a.dds 76 8 32 $((0x20000)) 0 8 255 0 0 0
words out/a.dds 108 2 $((0x1008)) $((0x200000))
holds out/a.dds 128 $volume$none

# Light from one bearing: its slice alone. From half a turn: a slice at each end, and a bearing b, turned on by a quarter
# so that fract wraps on the far side, lies 2 (fract(b + 1/4) - 1/4) slices from the first one.
run in/gray8.png -o out/a.raw $step --encoding tangent --arc 0 0
holds out/a.raw 0 $volume
[ "$(bytes out/a.raw)" -eq 8 ] || fail "one bearing took $(bytes out/a.raw) bytes"
run in/gray8.png -o out/a.raw $step --encoding tangent --arc -180 -180 --array --mips
holds out/a.raw 0 $none
grep -qF '"bearings":1,"phase":0.5,"arc":0,' stdout || fail "JSON of one bearing: $(cat stdout)"
grep -qF '"kind":"flat"' stdout || fail "JSON of one bearing: $(cat stdout)"
run in/gray8.png -o out/a.raw $step --encoding tangent --arc 0 180 --bearings 2
holds out/a.raw 0 $volume$none
wanted='"coordinate_start":-0.25,"coordinate_scale":1,"coordinate_offset":0,'
grep -qF "$wanted" stdout || fail "JSON of an arc: $(cat stdout)"
run in/gray8.png -o out/a.raw $step --encoding tangent --arc 0 180 --bearings 2 --array
grep -qF '"coordinate_start":-0.25,"coordinate_scale":2,"coordinate_offset":-0.5,' stdout || fail "JSON: $(cat stdout)"

# 16 bits: 16384, 21845, 32768, 65535.
run in/gray8.png -o out/a.raw $step --encoding tangent --bearings 2 --bits 16
holds out/a.raw 0 004055550080ffff$none$none$none
# Sines of slopes 1, 4/3, 2, 4 over that of 4: 0.7289, 0.8246, 0.9220, 1.
run in/gray8.png -o out/a.raw $step --encoding tangent --bearings 2 --stored sine
holds out/a.raw 0 bad2ebff00000000$none
# Slices 0 and 2 of four see the step of a map that tiles, from either side.
run in/gray8.png -o out/a.raw $exact --max-slope 4 --encoding layers --bearings 4
holds out/a.raw 0 4000ff005500800080005500ff004000$none$none
# An array of D3D10: DXGI_FORMAT_R8G8B8A8_UNORM, a 2D texture of one layer.
run in/gray8.png -o out/a.dds $exact --max-slope 4 --encoding layers --bearings 4
words out/a.dds 84 1 $((0x30315844))
words out/a.dds 128 5 28 3 0 1 0
[ "$(bytes out/a.dds)" -eq $((148 + 32)) ] || fail "array of $(bytes out/a.dds) bytes"

# ---- Bytes a texel, of 64 x 64 texels ----

# sized BYTES ARGUMENTS
sized() {
    wanted=$1
    shift
    rm -f out/*
    run in/hill.png -o out/a.raw --height-scale 4 "$@"
    [ "$(bytes out/a.raw)" -eq "$wanted" ] || fail "$* wrote $(bytes out/a.raw) bytes instead of $wanted"
}
sized $((64 * 64 * 8)) --encoding tangent
sized $((64 * 64 * 16)) --encoding tangent --bits 16
sized $((64 * 64 * 8)) --encoding tangent --bearings 16 --bits bc4
sized $((32 * 32 * 8)) --encoding tangent --reduce 2
sized $((64 * 64 * 8 + 32 * 32 * 8)) --encoding tangent --mips
sized $((64 * 64 * 8 + 32 * 32 * 8)) --encoding tangent --array --mips
sized $((64 * 64 * 5)) --encoding tangent --arc 90 270
sized $((64 * 64 * 3)) --encoding tangent --arc 350 370 --bearings 3
sized $((64 * 64)) --encoding tangent --arc 0 90 --bearings 1
sized $((64 * 64 * 16)) --encoding layers --bearings 16
sized $((64 * 64 * 16)) --encoding layers --bearings 12 --overlapping
sized $((64 * 64 * 8)) --encoding sine
sized $((64 * 64 * 8)) --encoding sine --published
sized $((64 * 64 * 5)) --encoding fourier
sized $((64 * 64 * 9)) --encoding fourier --coefficients 9
sized $((64 * 64 * 10)) --encoding fourier --bits 16
sized $((64 * 64 * 4)) --encoding ssbump
sized $((4 * (4096 + 1024 + 256 + 64 + 16 + 4 + 1))) --encoding ssbump --mips
sized $((64 * 64 * 2)) --encoding emboss

# Two textures are two files.
rm -f out/*
run in/block.png -o out/a.dds --height-scale 4 --encoding fourier
[ "$(left)" = './a.1.dds ./a.dds ' ] || fail "two textures: $(left)"

# ---- Other readers ----

run in/block.png -o out/b.raw --height-scale 4 --encoding emboss
run in/block.png -o out/b.dds --height-scale 4 --encoding emboss
if command -v convert >/dev/null; then
    convert out/b.dds -depth 8 gray:out/read
    head -c 1024 out/b.raw | cmp -s - out/read || fail "ImageMagick reads other bytes"
else
    echo "skipped: no ImageMagick here to read the files"
fi
if command -v iinfo >/dev/null; then
    # seen FILE TEXT
    seen() { iinfo -v "$1" | tr -s ' ' | grep -qF -e "$2" || fail "OpenImageIO sees in $1: $(iinfo -v "$1")"; }
    run in/hill.png -o out/c.dds --height-scale 4 --encoding tangent
    seen out/c.dds '64 x 64 x 8, 1 channel, volume uint8 dds'
    run in/block.png -o out/c.dds --height-scale 4 --encoding ssbump --mips
    seen out/c.dds 'MIP-map levels: 32x32 16x16 8x8 4x4 2x2 1x1'
    run in/block.png -o out/c.dds --height-scale 4 --encoding sine --factor-cube
    seen out/c.1.dds 'textureformat: "CubeFace Environment"'
    seen out/c.1.dds '+x -x +y -y +z -z'
    run in/hill.png -o out/c.dds --height-scale 4 --encoding tangent --bits bc4 --bearings 16
    seen out/c.dds '64 x 64 x 16, 1 channel, volume uint8 dds'
    seen out/c.dds 'compression: "BC4"'
else
    echo "skipped: no OpenImageIO here to read volumes and BC4"
fi

# ---- Refused ----

rm -f out/*
refuse 1 'the extension has to be .dds or .raw' in/block.png -o out/a.png --encoding tangent
refuse 1 '--bearings is not for --encoding emboss' in/block.png -o out/a.dds --encoding emboss --bearings 4
refuse 1 '--array is not for --encoding layers, but for tangent' in/block.png -o out/a.dds --encoding layers --array
refuse 1 '--arc is not for --encoding layers, but for tangent' in/block.png -o out/a.dds --encoding layers --arc 0 90
refuse 1 '--arc: 90 0 is given' in/block.png -o out/a.dds --arc 90 0
refuse 1 '--arc: 0 360 is given' in/block.png -o out/a.dds --arc 0 360
refuse 1 'arc is 0 but has to be positive' in/block.png -o out/a.dds --arc 10 10 --bearings 4
refuse 2 '--arc' in/block.png -o out/a.dds --arc 0 inf
refuse 2 '--arc' in/block.png -o out/a.dds --arc 10
refuse 1 'slices is 6 but has to be a multiple of 4' in/block.png -o out/a.dds --encoding layers --bearings 6
refuse 1 '--bearings 4 is given, but sine layers have 8' in/block.png -o out/a.dds --encoding sine --bearings 4
refuse 1 '--bits bc4 is not for' in/block.png -o out/a.dds --encoding layers --bits bc4
refuse 2 '--coefficients' in/block.png -o out/a.dds --encoding fourier --coefficients 4
refuse 2 '--max-slope' in/block.png -o out/a.dds --max-slope 0
refuse 1 'max_slope is inf' in/block.png -o out/a.dds --max-slope inf
refuse 2 '--encoding' in/block.png -o out/a.dds --encoding traced
refuse 1 'missing.png' in/missing.png -o out/a.dds
# What does not fit is clamped, counted and said.
"$program" in/gray8.png -o out/a.raw $exact --edge clamp --max-slope 2 --encoding tangent --bearings 2 >stdout 2>stderr ||
    fail "a small max_slope is refused"
grep -q '^bake: 1 values lie beyond' stderr || fail "clamped values are not counted: $(cat stderr)"
holds out/a.raw 0 80aaffff00000000$none

finish
