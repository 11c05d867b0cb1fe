# sh demo.sh DEMO IMAGES WORK_DIR
# shellcheck source=tests/programs/check.sh
. "$(dirname "$0")/check.sh"

# ---- What it writes ----

has_all() {
    for file in index.html surface.jpg elevation-15.png elevation-30.png elevation-50.png turning-00.png \
        turning-15.png turning.png heights.png horizons.png; do
        [ -s "$1/$file" ] || fail "$1/$file is missing"
    done
    # shellcheck disable=SC2013 # names without blanks
    for file in $(grep -o 'src="[^"]*"' "$1/index.html" | sed 's/src="//; s/"//'); do
        [ -s "$1/$file" ] || fail "$1/index.html shows $file, which is missing"
    done
    grep -q '://' "$1/index.html" && fail "$1/index.html needs the network"
    grep -q 'ns a sample' stdout || fail "no time: $(cat stdout)"
    grep -q 'mean [0-9.]* degrees, 99th percentile [0-9.]* degrees' stdout || fail "no error: $(cat stdout)"
    sed 's|\\|/|g' stdout | grep -q "Open .*/$1/index.html" || fail "where the page is: $(cat stdout)"
}

run -o out/wall
has_all out/wall
[ "$("$images" size out/wall/turning-00.png)" = '512 512 3' ] || fail "size of a frame"
[ "$(bytes out/wall/surface.jpg)" -le 400000 ] || fail "surface.jpg has $(bytes out/wall/surface.jpg) bytes"

# ---- A block on a plain: the shadow lies on the side that the light does not come from ----

run in/block.png -o out/new/folder --height-scale 6 --edge clamp
has_all out/new/folder
red() { "$images" pixel "out/new/folder/$1" "$2" "$3" | cut -d ' ' -f 1; }
darker() { [ "$(red "$1" "$2" "$3")" -lt "$(($(red "$1" "$4" "$5") / 2))" ] || fail "$1: light from the wrong side"; }
darker turning-00.png 9 16 22 16   # light from the right: dark to the left of the block
darker turning-04.png 16 9 16 22   # from below: dark above it
darker turning-08.png 22 16 9 16
darker turning-12.png 16 22 16 9
darker turning-02.png 10 10 21 21  # from the lower right

# Twice the same, bit for bit.
run in/block.png -o out/again --height-scale 6 --edge clamp --threads 1
for file in turning-03.png elevation-15.png horizons.png surface.jpg; do
    cmp -s out/again/$file out/new/folder/$file || fail "$file differs from run to run"
done

# Any size, any kind.
run in/gray8.png -o out/row
has_all out/row
printf '\000\000\000\000\000\000\000\000\000\000\200\100\000\000\000\000' >in/column.f32
run in/column.f32 -o out/column --raw 1 4 --edge open
has_all out/column
run in/column.f32 -o out/column --raw 1 4 --no-data 4
has_all out/column

"$program" --help >stdout 2>stderr || fail "--help ends with $?"

# ---- Bad input ----

rm -rf out
mkdir out
echo file >out/file
refuse 1 'in/none.png: No such file' in/none.png -o out/a
refuse 1 'broken PNG' in/cut.png -o out/a
refuse 1 'broken JPEG' in/cut.jpg -o out/a
refuse 1 'out/file/a' -o out/file/a
refuse 1 'out/file' -o out/file
refuse 2 '--texel-size: 0 is given' in/block.png -o out/a --texel-size 0 1
refuse 2 '--height-scale: nan is given' in/block.png -o out/a --height-scale nan
refuse 2 '--threads: 0 is given' in/block.png -o out/a --threads 0
refuse 2 '--edge: wrap is none of' in/block.png -o out/a --edge wrap
printf '\000\000\000\000\000\000\300\177' >in/nan.f32
refuse 1 'height is nan at texel (1, 0)' in/nan.f32 -o out/a --raw 2 1

# A file system that takes no more.
if [ -n "$posix" ]; then
    before=$(left)
    (ulimit -f 2 && "$program" in/bumps.png -o out/a/b >stdout 2>stderr) && fail "wrote more than the limit"
    grep -q 'cannot write out/a/b/' stderr || fail "full: $(cat stderr)"
    [ "$(left)" = "$before" ] || fail "full: left $(left)"
else
    echo "skipped: a full disk is a limit of POSIX here"
fi

finish
