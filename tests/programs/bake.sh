# sh bake.sh BAKE IMAGES WORK_DIR
# shellcheck disable=SC2086,SC2089,SC2090 # lists of words
# shellcheck source=tests/programs/check.sh
. "$(dirname "$0")/check.sh"

# ---- A step of height 4 between the fourth and the fifth of eight texels: slope 4 / distance in front of it ----

flat='0 0 0 0 0 0 0 0'
step='1 1.33333 2 4 0 0 0 0'
exact='--method exact --bearings 2 --edge clamp --height-scale 4'

run in/gray8.png -o out/a.f32 $exact
floats out/a.f32 $step $flat
run in/gray8.png -o out/a.f32 $exact --phase 0.5
floats out/a.f32 $flat $step
run in/gray8.png -o out/a.f32 $exact --texel-size 2 1
floats out/a.f32 0.5 0.66667 1 2 0 0 0 0 $flat
# A map that tiles has the step in front of its lower half on both sides; that is also the default.
run in/gray8.png -o out/a.f32 --method exact --bearings 2 --edge repeat --height-scale 4
floats out/a.f32 $step 4 2 1.33333 1 0 0 0 0
run in/gray8.png -o out/a.f32 --method exact --bearings 2 --height-scale 4
floats out/a.f32 $step 4 2 1.33333 1 0 0 0 0
# With a radius horizons can be negative: the texel on the brink looks down on all it sees.
run in/gray8.png -o out/a.f32 $exact --radius 2
floats out/a.f32 0 0 2 4 0 0 0 0 0 0 0 0 -2 0 0 0
run in/gray8.png -o out/a.f32 --method exact --bearings 2 --edge clamp --height-scale -4
floats out/a.f32 $flat 0 0 0 0 4 2 1.33333 1

# Samples of 16 bits stay as they are: two neighboring values differ.
run in/gray16.png -o out/a.f32 --method exact --bearings 2 --edge clamp --height-scale 262140
floats out/a.f32 $step $flat
run in/rgb_of_gray.png -o out/a.f32 $exact
floats out/a.f32 $step $flat

# A palette of two colors, and a ninth one in the picture, which is black.
{
    printf '\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122\000\000\000\010\000\000\000\001\010'
    printf '\003\000\000\000\324\336\037\161\000\000\000\006\120\114\124\105\200\200\200\377\377\377\347\326\215'
    printf '\254\000\000\000\016\111\104\101\124\170\234\143\340\004\002\106\040\000\000\000\375\000\051\130\314'
    printf '\213\076\000\000\000\000\111\105\116\104\256\102\140\202'
} >in/palette.png
run in/palette.png -o out/a.f32 $exact
floats out/a.f32 $step $flat

# Channels. Luminance: 0.2126 red + 0.7152 green + 0.0722 blue.
run in/rgb.png -o out/a.f32 $exact --channel red
floats out/a.f32 $step $flat
run in/rgb.png -o out/a.f32 $exact --channel green
floats out/a.f32 $flat $flat
run in/rgb.png -o out/a.f32 $exact --channel blue
floats out/a.f32 $flat 0 0 0 0 4 2 1.33333 1
run in/rgb.png -o out/a.f32 $exact
floats out/a.f32 0.1404 0.1872 0.2808 0.5616 0 0 0 0 $flat
run in/gray_alpha.png -o out/a.f32 $exact
floats out/a.f32 $flat $flat
run in/gray_alpha.png -o out/a.f32 $exact --channel alpha
floats out/a.f32 $step $flat
run in/rgba16.png -o out/a.f32 $exact --channel alpha
floats out/a.f32 $flat 0 0 0 0 4 2 1.33333 1
run in/rgba16.png -o out/a.f32 --method exact --bearings 2 --edge clamp --height-scale 5.59284
floats out/a.f32 $step $flat

# Raw: 0 0 4 0 as a column of 1 x 4; bearing 0.25 looks down the rows.
printf '\000\000\000\000\000\000\000\000\000\000\200\100\000\000\000\000' >in/column.f32
run in/column.f32 -o out/a.f32 --raw 1 4 --method exact --bearings 4 --edge clamp
floats out/a.f32 0 0 0 0 2 4 0 0 0 0 0 0 0 0 0 4
run in/column.f32 -o out/a.f32 --raw 1 4 --method exact --bearings 4 --edge clamp --height-scale 0.5
floats out/a.f32 0 0 0 0 1 2 0 0 0 0 0 0 0 0 0 2

# JPEG: the step of 255 lies between columns 8 and 9 of 16.
run in/gray.jpg -o out/a.f32 --method exact --bearings 1 --edge clamp --height-scale 8
od -An -v -tf4 -N 32 out/a.f32 | tr '\n' ' ' |
    awk '{ for (i = 1; i <= 8; ++i) { d = $i - 8 / (9 - i); if (d > 0.1 || d < -0.1) exit 1 } }' ||
    fail "JPEG: $(od -An -tf4 -N 32 out/a.f32)"

# ---- What comes out ----

for method in exact cascade sweep sweep-classic neighborhood; do
    bearings=5
    [ $method = neighborhood ] && bearings=8
    run in/block.png -o out/a.f32 --height-scale 4 --bearings $bearings --method $method --json --threads 1
    [ "$(bytes out/a.f32)" -eq $((32 * 32 * bearings * 4)) ] || fail "$method wrote $(bytes out/a.f32) bytes"
    # Numbers but for the ones that are known become N.
    json=$(sed -E 's/("(seconds|ns_per_sample|steps)":)[0-9]+(\.[0-9]+)?/\1N/g' stdout)
    wanted='{"width":32,"height":32,"bearings":'$bearings',"method":"'$method'","threads":1'
    [ "$json" = "$wanted"',"seconds":N,"ns_per_sample":N,"steps":N}' ] ||
        fail "JSON of $method: $(cat stdout)"
    [ "$(wc -l <stdout)" -eq 1 ] || fail "$method prints more than one line of JSON"
    run in/block.png -o out/b.f32 --height-scale 4 --bearings $bearings --method $method --threads 3
    cmp -s out/a.f32 out/b.f32 || fail "$method depends on the number of threads"
    [ "$(wc -l <stdout)" -eq 1 ] || fail "$method prints more than one line"
done
run in/block.png -o out/a.f32
[ "$(bytes out/a.f32)" -eq $((32 * 32 * 16 * 4)) ] || fail "16 bearings are the default"

run in/gray8.png -o out/a.PNG $exact
[ "$("$images" size out/a.PNG)" = "16 1 1" ] || fail "slices side by side are $("$images" size out/a.PNG)"
# 90 degrees would be 255: atan 2 is 63.43 degrees, atan 4 is 75.96.
for pixel in '2 180' '3 215' '4 0' '11 0'; do
    [ "$("$images" pixel out/a.PNG "${pixel% *}" 0)" = "${pixel#* } " ] || fail "slice pixel $pixel"
done

# An output that was there is replaced; a name with blanks is a name.
echo old >'out/a b.f32'
run in/gray8.png -o 'out/a b.f32' $exact
floats 'out/a b.f32' $step $flat

"$program" --help >stdout 2>stderr || fail "--help ends with $?"
for option in --height-scale --texel-size --edge --method --steps --radius --curvature --bearings --phase --threads \
    --json --channel --raw --no-data --output; do
    grep -qF -e "$option" stdout || fail "--help does not list $option"
done

# Letters that no code page of one byte has together.
cp in/gray8.png 'in/Höhe–高.png'
run 'in/Höhe–高.png' -o 'out/浮き彫り–α.f32' $exact
floats 'out/浮き彫り–α.f32' $step $flat
run 'in/Höhe–高.png' -o 'out/浮き彫り–α.f32' $exact
refuse 1 'in/Höhe–低.png: No such file' 'in/Höhe–低.png' -o out/b.f32

# ---- Bad input ----

rm -rf out
mkdir out
map=in/gray8.png
refuse 2 'HEIGHTS is required'
refuse 2 '--output is required' $map
refuse 2 '--nonsense' $map -o out/a.f32 --nonsense
refuse 2 'more' $map more -o out/a.f32
refuse 1 'in/none.png: No such file' in/none.png -o out/a.f32
refuse 1 'in: Is a directory' in -o out/a.f32
refuse 1 'in/empty.png: the file is empty' in/empty.png -o out/a.f32
refuse 1 'in/text.png: neither PNG nor JPEG' in/text.png -o out/a.f32
refuse 1 'in/cut.png: broken PNG: the file ends too early' in/cut.png -o out/a.f32
refuse 1 'in/flipped.png: broken PNG: wrong checksum' in/flipped.png -o out/a.f32
refuse 1 'in/no_width.png: broken' in/no_width.png -o out/a.f32
printf '\377\330\377\304\000\023\000\377\377\377\377\377\377\377\377' >in/codes.jpg
printf '\377\377\377\377\377\377\377\377\377\332\377\331' >>in/codes.jpg
refuse 1 'in/codes.jpg: broken JPEG: a table of more than 256 codes' in/codes.jpg -o out/a.f32
refuse 1 'in/cut.jpg: broken JPEG: the file ends too early' in/cut.jpg -o out/a.f32

refuse 2 "--texel-size: 0 is given" $map -o out/a.f32 --texel-size 0 1
refuse 2 "--texel-size: -2 is given" $map -o out/a.f32 --texel-size 1 -2
refuse 2 "--texel-size: nan is given" $map -o out/a.f32 --texel-size nan 1
refuse 2 "--texel-size: inf is given" $map -o out/a.f32 --texel-size inf 1
refuse 2 "--texel-size" $map -o out/a.f32 --texel-size 1
refuse 2 "--height-scale: nan is given" $map -o out/a.f32 --height-scale nan
refuse 2 "--height-scale: inf is given" $map -o out/a.f32 --height-scale inf
refuse 2 "--height-scale: 'high' is not a number" $map -o out/a.f32 --height-scale high
refuse 2 "--radius: 0 is given" $map -o out/a.f32 --radius 0
refuse 2 "--radius: -3 is given" $map -o out/a.f32 --radius -3
refuse 2 "--radius: nan is given" $map -o out/a.f32 --radius nan
refuse 2 "--steps: 0 is given" $map -o out/a.f32 --steps 0
refuse 2 "--steps: -1 is given" $map -o out/a.f32 --steps -1
refuse 2 "--steps: '1.5' is not a whole number" $map -o out/a.f32 --steps 1.5
refuse 2 "--bearings: 0 is given" $map -o out/a.f32 --bearings 0
refuse 2 "--bearings: -16 is given" $map -o out/a.f32 --bearings -16
refuse 2 "--bearings: 99999999999 is given" $map -o out/a.f32 --bearings 99999999999
refuse 2 "--threads: 0 is given" $map -o out/a.f32 --threads 0
refuse 2 "--phase: nan is given" $map -o out/a.f32 --phase nan
refuse 2 "--curvature: inf is given" $map -o out/a.f32 --curvature 0 inf
refuse 1 "curvature" $map -o out/a.f32 --curvature -0.1 0
refuse 2 "--edge: wrap is none of repeat" $map -o out/a.f32 --edge wrap
refuse 2 "--method: magic is none of cascade" $map -o out/a.f32 --method magic
refuse 2 "--channel: gold is none of luminance" $map -o out/a.f32 --channel gold
refuse 1 "no alpha channel" $map -o out/a.f32 --channel alpha
refuse 1 "--no-data 256 is given" $map -o out/a.f32 --no-data 256
refuse 1 "--no-data 1.5 is given" $map -o out/a.f32 --no-data 1.5
refuse 1 "--phase 0.25 is given" $map -o out/a.dds --encoding tangent --phase 0.25
# Empty, as of a script's variable that is not set: not the same as no option.
refuse 2 "HEIGHTS: '' is given" '' -o out/a.f32
refuse 2 "--output: '' is given" $map -o ''
refuse 2 "--plan: '' is given" $map -o out/a.dds --plan ''
refuse 2 "--recipe: '' is given" $map -o out/a.dds --recipe ''
refuse 2 "--save-recipe: '' is given" $map -o out/a.dds --plan scene.json --save-recipe ''

refuse 2 "--raw: 0 is given" in/column.f32 -o out/a.f32 --raw 0 4
refuse 2 "--raw: -1 is given" in/column.f32 -o out/a.f32 --raw -1 4
refuse 1 "it has 16 bytes, but --raw 1 5 needs 4 for each texel" in/column.f32 -o out/a.f32 --raw 1 5
printf '\000\000\000\000\000\000\000\000\000\000\000\000\000\000\300\177\000\000\000\000\000\000\300\177' >in/nan.f32
refuse 1 "height is nan at texel (1, 1)" in/nan.f32 -o out/a.f32 --raw 2 3
printf '\000\000\000\000\000\000\200\377' >in/infinite.f32
refuse 1 "height is -inf at texel (1, 0)" in/infinite.f32 -o out/a.f32 --raw 2 1
# Marked as a hole it is no error.
run in/nan.f32 -o out/a.f32 --raw 2 3 --no-data nan
rm -f out/a.f32

refuse 1 'out/a.txt: the extension has to be .f32, .png' $map -o out/a.txt
refuse 1 'the extension has to be .f32, .png' $map -o out/a
refuse 1 'out/none/a.f32: No such file' $map -o out/none/a.f32
refuse 1 'it is read from' $map -o in/../in/gray8.png
# Nor is it the second texture.
head -c 4096 /dev/zero >in/a.1.dds
refuse 1 'cannot write in/a.1.dds: it is read from' in/a.1.dds --raw 32 32 -o in/a.dds --encoding fourier
[ "$(bytes in/a.1.dds)" -eq 4096 ] || fail "the height map was written over"
[ ! -e in/a.dds ] || fail "the first texture was left"
mkdir out/folder.f32
refuse 1 'out/folder.f32: Is a directory' $map -o out/folder.f32
rmdir out/folder.f32
refuse 1 'too large for a PNG' in/bumps.png -o out/a.png --bearings 65536

# Ended by a signal, here one from inside, which Windows has, too.
"$images" interrupt out/interrupted >stdout 2>stderr && fail "interrupted: ended with 0"
[ -z "$(left)" ] || fail "interrupted: left $(left)"

if [ -n "$posix" ]; then
    # A file system that takes no more: what was there stays as it was.
    echo old >out/full.f32
    (ulimit -f 8 && "$program" in/bumps.png -o out/full.f32 >stdout 2>stderr) && fail "wrote more than the limit"
    grep -q 'cannot write out/full.f32' stderr || fail "full: $(cat stderr)"
    [ "$(cat out/full.f32)" = old ] || fail "full: the old file is gone"
    [ "$(left)" = './full.f32 ' ] || fail "full: left $(left)"
    rm out/full.f32

    if [ -w /dev/full ]; then
        "$program" $map -o out/a.f32 >/dev/full 2>stderr && fail "standard output was full and nobody noticed"
        rm -f out/a.f32
        "$program" --help >/dev/full 2>stderr && fail "--help: standard output was full and nobody noticed"
    fi

    # Ended from outside in the middle of the work.
    for signal in INT TERM; do
        # A shell lets its background jobs ignore SIGINT; env gives the program the default again where it can.
        reset=''
        env --default-signal=INT true 2>/dev/null && reset='env --default-signal=INT'
        [ $signal = INT ] && [ -z "$reset" ] && continue
        $reset "$program" in/bumps.png -o out/long.f32 --method exact --bearings 600 --height-scale 20 >stdout 2>stderr &
        running=$!
        tries=0
        while [ ! -e out/long.f32.part ] && [ $tries -lt 200 ]; do
            tries=$((tries + 1))
            sleep 0.05
        done
        [ -e out/long.f32.part ] || fail "no part to be seen before SIG$signal"
        kill -s $signal $running
        { wait $running; } 2>/dev/null && fail "SIG$signal: ended with 0"
        [ -z "$(left)" ] || fail "SIG$signal: left $(left)"
    done
else
    echo "skipped: a full disk and signals from outside are those of POSIX here"
fi

# ---- Real maps ----

maps=${BUMPSHADOW_HEIGHT_MAPS:-}
if [ -r "$maps/MANIFEST.tsv" ]; then
    tab=$(printf '\t')
    sed 1d "$maps/MANIFEST.tsv" | while IFS="$tab" read -r file scale texel_size width height rest; do
        "$program" "$maps/$file" -o out/real.f32 --bearings 2 --height-scale "$scale" --texel-size $texel_size \
            >stdout 2>stderr &&
            [ "$(bytes out/real.f32)" -eq $((width * height * 2 * 4)) ] || echo "$file: $(cat stderr)"
    done >real
    [ ! -s real ] || fail "$(cat real)"
else
    echo "skipped: real maps (BUMPSHADOW_HEIGHT_MAPS names no folder with a MANIFEST.tsv)"
fi

finish
