# sh shade.sh SHADE IMAGES WORK_DIR
# shellcheck disable=SC2086 # lists of words
# shellcheck source=tests/programs/check.sh
. "$(dirname "$0")/check.sh"

# shows FILE X Y LOW HIGH: the first channel of a pixel
shows() {
    found=$("$images" pixel "$1" "$2" "$3" | cut -d ' ' -f 1)
    [ "$found" -ge "$4" ] && [ "$found" -le "$5" ] || fail "$1 shows $found at $2 $3, not $4 to $5"
}

# ---- A block 4 texels high in the middle of a plain: its shadow lies on the far side of the light ----
# Light from +x at 45 degrees reaches the ground 4 texels behind the block's edge, which lies between x = 13 and 14.

light='--height-scale 4 --edge clamp --factor --hard'
for encoding in 'traced' 'tangent --bearings 16' 'tangent --bearings 16 --bits bc4' 'tangent --array' 'layers' \
    'layers --overlapping' 'sine' 'sine --published' 'fourier --coefficients 9' 'tangent --bits 16 --stored angle'; do
    run in/block.png -o out/a.png $light --encoding $encoding --light 0 35
    shows out/a.png 12 16 0 0
    shows out/a.png 11 16 0 0
    shows out/a.png 19 16 255 255
    shows out/a.png 20 16 255 255
    run in/block.png -o out/a.png $light --encoding $encoding --light 90 35
    shows out/a.png 16 12 0 0
    shows out/a.png 16 19 255 255
    run in/block.png -o out/a.png $light --encoding $encoding --light 180 35
    shows out/a.png 19 16 0 0
    shows out/a.png 12 16 255 255
    run in/block.png -o out/a.png $light --encoding $encoding --light 270 35
    shows out/a.png 16 19 0 0
    shows out/a.png 16 12 255 255
    # Straight up everything is lit, from below nothing.
    run in/block.png -o out/a.png $light --encoding $encoding --light 0 90
    shows out/a.png 12 16 255 255
    run in/block.png -o out/a.png $light --encoding $encoding --light 0 -10
    shows out/a.png 2 2 0 0
done
[ "$("$images" size out/a.png)" = '32 32 1' ] || fail "size: $("$images" size out/a.png)"

# Exactly as far as the light is low: slope 1 reaches the last texel whose horizon is 1, 4 texels away from the top.
run in/block.png -o out/a.png $light --encoding traced --light 0 45
shows out/a.png 10 16 255 255
shows out/a.png 11 16 0 0

# A soft edge: factors between 0 and 1 beside the hard one.
run in/block.png -o out/a.png --height-scale 4 --edge clamp --factor --encoding traced --light 0 45 --light-radius 5
shows out/a.png 10 16 100 155
shows out/a.png 11 16 0 0
shows out/a.png 9 16 255 255
run in/block.png -o out/a.png --height-scale 4 --edge clamp --factor --encoding traced --light 0 45 --k 8 --c 1
shows out/a.png 10 16 255 255

# Embossing: the side that faces the light is brightened, the other one darkened, the plain stays.
for azimuth in 0 180; do
    run in/hill.png -o out/a.png --height-scale 4 --factor --encoding emboss --light $azimuth 0 --shift 4
    lit=$([ $azimuth = 0 ] && echo 40 || echo 20)
    shows out/a.png $lit 32 129 255
    shows out/a.png $((60 - lit)) 32 0 127
done
# SSBump: brightness, less in the shadow than in the open.
run in/block.png -o out/a.png --height-scale 4 --edge clamp --factor --encoding ssbump --light 0 35
shows out/a.png 4 16 90 160
shows out/a.png 12 16 0 89

# ---- Pictures ----

run in/hill.png -o out/b.png --height-scale 8 --encoding none
[ "$("$images" size out/b.png)" = '64 64 3' ] || fail "size: $("$images" size out/b.png)"
for sheet in bearings turning cube edges emboss; do
    run in/hill.png -o out/b.png --height-scale 8 --sheet $sheet
    case $sheet in
        bearings | emboss) wanted='352 64 3' ;;
        turning) wanted='208 208 3' ;;
        cube) wanted='1032 384 3' ;;
        edges) wanted='136 64 3' ;;
    esac
    [ "$("$images" size out/b.png)" = "$wanted" ] || fail "sheet $sheet: $("$images" size out/b.png), not $wanted"
done
# Beside the middle of the +x face, red: 3.58 of 45 degrees from bearing 0, a factor of 0.92, stored as 0.96.
run in/hill.png -o out/b.png --sheet cube
shows out/b.png 320 192 244 246
# Lightmaps, of any size: gray 200, 100, 0 and masks of 1/sqrt(3) on the plain give 0.577 (200 + 100) / 255 = 0.68.
run in/block.png -o out/b.png --height-scale 0.001 --encoding ssbump --lightmap in/rgb_of_gray.png in/rgb_of_gray.png \
    in/rgb_of_gray.png
run in/hill.png -o out/b.png --height-scale 8 --encoding ssbump --detail in/gray8.png
run in/hill.png -o out/b.png --height-scale 8 --gpu-weights --reduce 2 --mips
run in/rgb.png -o out/b.png --height-scale 4 --channel red --normal in/rgb.png --normal-y down --diffuse in/rgb.png

# ---- Refused ----

rm -f out/*
refuse 1 'the extension has to be .png' in/block.png -o out/a.jpg
refuse 1 'it is read from' in/block.png -o in/block.png
cp in/rgb_of_gray.png out/light.png
refuse 1 'out/light.png: it is read from' in/block.png -o out/light.png --encoding ssbump --lightmap in/rgb.png \
    out/light.png in/rgb.png
rm out/light.png
refuse 1 'has 8 x 1 pixels, but the height map has 32 x 32' in/block.png -o out/a.png --diffuse in/rgb.png
refuse 1 'has no three channels' in/gray8.png -o out/a.png --normal in/gray8.png
refuse 1 'are for --encoding ssbump' in/block.png -o out/a.png --detail in/gray8.png
refuse 2 '--lightmap' in/block.png -o out/a.png --encoding ssbump --lightmap in/gray8.png
refuse 2 'is no sheet' in/block.png -o out/a.png --sheet nonsense
refuse 2 '--light' in/block.png -o out/a.png --light 0
refuse 2 '--light-radius' in/block.png -o out/a.png --light-radius 50
refuse 1 'missing.png' in/missing.png -o out/a.png
refuse 1 'nowhere' in/block.png -o nowhere/a.png

finish
