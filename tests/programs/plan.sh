# sh plan.sh PLAN IMAGES WORK_DIR BAKE SHADE
# Scenes and recipes from files: what is understood, what is refused, and what is left behind.
# shellcheck disable=SC2086 # lists of words
# shellcheck source=tests/programs/check.sh
. "$(dirname "$0")/check.sh"
plan=$program bake=$4 shade=$5

# scene TEXT: writes scene.json
scene() { printf '%s\n' "$1" >scene.json; }
# says TEXT...: the last output has them all
says() {
    for text; do grep -qF -e "$text" stdout || fail "does not say '$text': $(cat stdout)"; done
}
# bad_scene KEY TEXT: is refused by plan, bake and shade with one line that has both words
bad_scene() {
    scene "$2"
    for word in "$1" scene.json; do
        program=$plan
        refuse 1 "$word" scene.json in/hill.png --json out/plan.json
        program=$bake
        refuse 1 "$word" in/hill.png -o out/a.dds --save-recipe out/r.json --plan scene.json
        program=$shade
        refuse 1 "$word" in/hill.png -o out/a.png --save-recipe out/r.json --plan scene.json
    done
    program=$plan
}

hill='--height-scale 80'
sun='{"lights": [{"azimuth": 0, "elevation": 20}], "mismatch": 0.02}'

# ---- plan ----

scene "$sun"
run scene.json in/hill.png $hill --json out/plan.json
says 'in/hill.png: planned in' 'predicted: ' 'one slice'
grep -qF '"kind":"flat"' out/plan.json || fail "no flat texture: $(cat out/plan.json)"
run scene.json in/hill.png in/block.png $hill --measure
says 'in/hill.png: ' 'in/block.png: ' 'measured: '
# Nothing has to be said: light from anywhere.
scene '{}'
run scene.json in/hill.png $hill
says 'slices around the turn'
scene '{"arc": {"azimuth": [90, 270], "elevation": [5, 60]}, "mismatch": 0.03, "bc4": false}'
run scene.json in/hill.png $hill --json out/plan.json
grep -qF '"format":"r8"' out/plan.json || fail "BC4 without BC4: $(cat out/plan.json)"
scene '{"positions": [[0, 0, 8], [64, 64, 8]], "mismatch": 0.05, "volumes": false, "normals": false, "lightmaps": true}'
run scene.json in/hill.png $hill --json out/plan.json
says 'normal map'
grep -qF '"volume"' out/plan.json && fail "a volume without volumes: $(cat out/plan.json)"
rm -f out/*

# ---- bake and shade: the recipe of a scene, and the same from its file ----

for asked in "$sun" '{"mismatch": 0.03}' '{"arc": {"azimuth": [-30, 100.5]}, "mismatch": 0.03}' '{"texels_per_pixel": 8}'; do
    scene "$asked"
    program=$bake
    run in/hill.png $hill -o out/a.raw --plan scene.json --save-recipe out/a.json
    says '"recipe":{"shadows":true' '"textures":[' '"max_slope":'
    run in/hill.png $hill -o out/b.raw --recipe out/a.json --save-recipe out/b.json
    cmp -s out/a.raw out/b.raw || fail "another texture from the recipe of $asked"
    cmp -s out/a.json out/b.json || fail "$asked: the recipe changed on its way: $(cat out/a.json out/b.json)"
    [ "$(bytes out/a.raw)" -gt 0 ] || fail "$asked: an empty texture"
    run in/hill.png $hill -o out/a.dds --recipe out/a.json
    says 'predicted: '
    [ "$(head -c 4 out/a.dds)" = 'DDS ' ] || fail "$asked: no DDS file"
    program=$shade
    run in/hill.png $hill -o out/a.png --plan scene.json --light 0 20 --factor --save-recipe out/c.json
    run in/hill.png $hill -o out/b.png --recipe out/c.json --light 0 20 --factor
    cmp -s out/a.png out/b.png || fail "$asked: another picture from the recipe"
done
rm -f out/*

# One bearing, one slice: 64 x 64 bytes at the most; and the block's shadow lies behind it, 4 texels at 45 degrees.
program=$shade
scene '{"lights": [{"azimuth": 0, "elevation": 35}], "mismatch": 0.001, "bc4": false}'
run in/block.png --height-scale 4 --edge clamp -o out/a.png --plan scene.json --light 0 35 --factor
for place in '12 0' '11 0' '19 255' '4 255'; do
    [ "$("$images" pixel out/a.png ${place% *} 16 | cut -d ' ' -f 1)" = "${place#* }" ] ||
        fail "the block's shadow: $("$images" pixel out/a.png ${place% *} 16) at ${place% *}, not ${place#* }"
done
program=$bake
run in/block.png --height-scale 4 --edge clamp -o out/a.raw --plan scene.json
[ "$(bytes out/a.raw)" -le 1024 ] || fail "one slice of $(bytes out/a.raw) bytes"
says '"kind":"flat"'
rm -f out/*

# ---- No shadows: nothing is written but the recipe ----

# Four steps of 80/255 a texel in x and three in y: 57.5 degrees at the steepest.
scene '{"lights": [{"azimuth": 0, "elevation": 60}]}'
run in/hill.png $hill -o out/a.dds --plan scene.json --save-recipe out/r.json
says 'out/a.dds is not written' 'no shadows at all'
[ ! -e out/a.dds ] || fail 'wrote a texture that nothing needs'
grep -qF '"shadows":false' out/r.json || fail "$(cat out/r.json)"
run in/hill.png $hill -o out/a.dds --recipe out/r.json --json
says '"shadows":false'
[ ! -e out/a.dds ] || fail 'wrote a texture that nothing needs'
program=$plan
run scene.json in/hill.png $hill --measure
says 'no shadows at all'
program=$shade
run in/hill.png $hill -o out/a.png --plan scene.json --light 0 60 --factor
says 'no shadows'
[ "$("$images" pixel out/a.png 20 20)" = '255 ' ] || fail "shadow without shadows"
rm -f out/*

# ---- Scenes that are refused ----

bad_scene 'unknown key "ligths"' '{"ligths": []}'
bad_scene 'unknown key "elevations": [1,2]' '{"arc": {"elevations": [1, 2]}}'
bad_scene 'lights[0] has an unknown key "color"' '{"lights": [{"azimuth": 0, "elevation": 5, "color": 1}]}'
bad_scene 'lights[0] has no "elevation"' '{"lights": [{"azimuth": 0}]}'
bad_scene 'lights is [], but' '{"lights": []}'
bad_scene 'positions is [], but' '{"positions": []}'
bad_scene 'lights is 3, but has to be a list' '{"lights": 3}'
bad_scene 'lights[0].elevation is 91, but' '{"lights": [{"azimuth": 0, "elevation": 91}]}'
bad_scene 'lights[0].azimuth is "east", but has to be a number' '{"lights": [{"azimuth": "east", "elevation": 5}]}'
bad_scene 'positions[0] is [1,2], but' '{"positions": [[1, 2]]}'
bad_scene 'positions[0] is [1,2,0], but z has to be above 0' '{"positions": [[1, 2, 0]]}'
bad_scene '"arc": {} is given beside "lights"' '{"lights": [{"azimuth": 0, "elevation": 5}], "arc": {}}'
bad_scene 'arc.azimuth is [90,90], but' '{"arc": {"azimuth": [90, 90]}}'
bad_scene 'arc.azimuth is [0,361], but' '{"arc": {"azimuth": [0, 361]}}'
bad_scene 'arc.azimuth is [0], but has to be two numbers' '{"arc": {"azimuth": [0]}}'
bad_scene 'arc.elevation is [5,91], but' '{"arc": {"elevation": [5, 91]}}'
bad_scene 'arc.elevation is [50,5], but' '{"arc": {"elevation": [50, 5]}}'
bad_scene 'bytes is -1, but has to be above 0' '{"bytes": -1}'
bad_scene 'bake_seconds is 0, but has to be above 0' '{"bake_seconds": 0}'
bad_scene 'gpu_cost is null, but has to be a number' '{"gpu_cost": null}'
bad_scene 'mismatch is -0.1, but has to be at least 0' '{"mismatch": -0.1}'
bad_scene 'degrees is "1", but has to be a number' '{"degrees": "1"}'
bad_scene 'light_radius is 46, but' '{"light_radius": 46}'
bad_scene 'texels_per_pixel is 0.5, but' '{"texels_per_pixel": 0.5}'
bad_scene 'bc4 is 1, but has to be true or false' '{"bc4": 1}'
bad_scene '"mismatch" is there twice' '{"mismatch": 0.1, "mismatch": 0.2}'
bad_scene 'is no JSON' '{"mismatch": 0.1'
bad_scene 'is no JSON' ''
bad_scene 'is no JSON' '{"mismatch": 1e999}'
bad_scene 'has to be an object' '[1]'

# ---- Mips, which a recipe may be given ----

program=$bake
for asked in '{"mismatch": 0.05, "bc4": false, "volumes": false}' \
    '{"mismatch": 0.05, "bc4": false, "volumes": false, "arc": {"azimuth": [0, 90]}}'; do
    scene "$asked"
    run in/hill.png $hill -o out/a.raw --plan scene.json --save-recipe out/a.json
    # At full size: what is reduced may have no levels.
    sed 's/"reduced_heights":[0-9]*/"reduced_heights":1/; s/"reduction":[0-9]*/"reduction":1/' out/a.json >out/b.json
    sed 's/"mips":false/"mips":true/' out/b.json >out/m.json
    run in/hill.png $hill -o out/a.raw --recipe out/b.json
    run in/hill.png $hill -o out/m.raw --recipe out/m.json
    # 64 x 64 texels have one level more, of 32 x 32.
    one=$(wc -c <out/a.raw) all=$(wc -c <out/m.raw)
    [ "$all" -eq $((one * 5 / 4)) ] || fail "$one bytes, with mips $all"
done
rm -f out/*

# ---- Recipes that are refused ----

program=$bake
scene "$sun"
run in/hill.png $hill -o out/a.raw --plan scene.json --save-recipe good.json
rm -f out/*
# bad_recipe TEXT FROM TO: the good one with a change
bad_recipe() {
    sed "s/$2/$3/" good.json >recipe.json
    cmp -s good.json recipe.json && fail "no $2 in the recipe: $(cat good.json)"
    refuse 1 "$1" in/hill.png -o out/a.raw --recipe recipe.json
}
bad_recipe 'bake has an unknown key "step": 1' '"steps"' '"step":1,"steps"'
bad_recipe 'has no "shader"' '"shader":{[^}]*},' ''
bad_recipe 'bake.steps is 0, but' '"steps":[0-9]*' '"steps":0'
bad_recipe 'texture.slices is "1", but' '"slices":1' '"slices":"1"'
bad_recipe 'texture.kind is "cube", but has to be one of flat, array, volume' '"kind":"flat"' '"kind":"cube"'
bad_recipe 'bake.radius is -1, but' '"radius":[^,]*' '"radius":-1'
bad_recipe 'texture' '"max_slope":[^,]*' '"max_slope":-1'
bad_recipe 'bake.method is "sweep", but' '"cascade"' '"sweep"'
bad_recipe 'is no JSON' '.$' ''

# ---- Options that do not go together ----

for given in '--bits bc4' '--steps 4' '--encoding sine' '--bearings 16' '--curvature 0 0' '--mips' '--max-slope 2' '--phase 0'; do
    refuse 1 "$given does not go with --plan" in/hill.png -o out/a.dds --plan scene.json $given
done
refuse 1 '--reduce 2 does not go with --recipe' in/hill.png -o out/a.dds --recipe good.json --reduce 2
refuse 2 '--recipe' in/hill.png -o out/a.dds --plan scene.json --recipe good.json
refuse 1 '--save-recipe out/r.json is given, but neither' in/hill.png -o out/a.dds --save-recipe out/r.json
refuse 1 'the extension has to be .dds or .raw' in/hill.png -o out/a.f32 --plan scene.json
refuse 1 'scene.json: it is read from' in/hill.png -o out/a.dds --plan scene.json --save-recipe scene.json
refuse 1 'in/hill.png: it is read from' in/hill.png -o out/a.dds --plan scene.json --save-recipe in/hill.png
cp scene.json in/scene.dds
refuse 1 'in/scene.dds: it is read from' in/hill.png -o in/scene.dds --plan in/scene.dds
refuse 1 'in/scene.dds: it is read from' in/hill.png -o in/scene.dds --recipe in/scene.dds
rm in/scene.dds
refuse 1 'out/a.dds: it is what --output names' in/hill.png -o out/a.dds --plan scene.json --save-recipe out/a.dds
refuse 1 'nowhere' in/hill.png -o out/a.dds --plan scene.json --save-recipe nowhere/r.json
refuse 1 'missing.json' in/hill.png -o out/a.dds --plan missing.json
program=$shade
for given in '--hard' '--k 8' '--light-radius 1' '--sheet cube' '--encoding none'; do
    refuse 1 "$given does not go with --plan" in/hill.png -o out/a.png --plan scene.json $given
done
refuse 1 'in/missing.png' in/missing.png -o out/a.png --plan scene.json
program=$plan
refuse 1 'SCENE.json is missing'
refuse 1 'HEIGHTS is missing' scene.json
refuse 1 '--check goes with --proof' scene.json in/hill.png --check
refuse 1 'but --proof has its own scenes' scene.json in/hill.png --proof
refuse 1 'scene.json: it is read from' scene.json in/hill.png --json scene.json
refuse 1 'in/hill.png: it is read from' scene.json in/hill.png --json in/hill.png
refuse 1 'nowhere' scene.json in/hill.png --json nowhere/plan.json
(unset BUMPSHADOW_HEIGHT_MAPS; refuse 1 'BUMPSHADOW_HEIGHT_MAPS' --proof --json out/proof.json; exit $failures) ||
    failures=$((failures + $?))

finish
