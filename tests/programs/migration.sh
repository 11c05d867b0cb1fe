# sh migration.sh BAKE IMAGES WORK_DIR PAGE PROGRAMS: runs the commands of examples/migration.md.
page=$4 programs=$5
# shellcheck source=tests/programs/check.sh
. "$(dirname "$0")/check.sh"

cp in/hill.png heights.png
cp in/normals.png normals.png
awk '/^```sh$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$page" |
    sed "s|build/release/examples/|\"$programs\"/|; s/512x512/64x64/" >commands
[ "$(grep -c . commands)" -ge 10 ] || fail "the page has no more than $(grep -c . commands) commands"
if ! command -v convert >/dev/null; then
    echo "skipped: convert (no ImageMagick here)"
    sed '/^convert/d' commands >rest && mv rest commands
fi
sh -eu commands >stdout 2>stderr || fail "$(cat stderr)"

for file in wall-h1.rgba wall-h2.rgba wall-ssbump.raw; do
    [ "$(bytes $file)" -eq $((64 * 64 * 4)) ] || fail "$file has $(bytes $file) bytes"
done
[ "$(bytes horizons.dds)" -gt $((64 * 64 * 8)) ] || fail "horizons.dds has $(bytes horizons.dds) bytes"
for picture in yours.png ours.png; do
    [ "$("$images" size $picture)" = "64 64 3" ] || fail "$picture is $("$images" size $picture)"
done
for name in sine_layers sine shadow_soft; do
    grep -q "^float bumpshadow_$name(" shadow.glsl || fail "shadow.glsl lacks $name"
done
# Red, green and blue as the masks are.
if [ -e wall-ssbump.tga ]; then
    convert wall-ssbump.tga -depth 8 rgb:read
    convert -size 64x64 -depth 8 rgba:wall-ssbump.raw -alpha off rgb:written
    cmp -s read written || fail "the TGA holds other masks"
    [ "$(bytes read)" -eq $((64 * 64 * 3)) ] || fail "the TGA has $(bytes read) bytes of color"
fi

finish
