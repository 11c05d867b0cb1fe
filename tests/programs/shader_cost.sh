# sh shader_cost.sh SHADER_COST IMAGES WORK_DIR SNIPPETS CMAKE
# shellcheck source=tests/programs/check.sh
. "$(dirname "$0")/check.sh"
snippets=$4 cmake=$5
mkdir tmp
TMPDIR=$work/tmp
export TMPDIR

# json FILE PATH...: a member of a JSON file, by a parser; a number for the length of lists.
cat >json.cmake <<'END'
file(READ "${CMAKE_ARGV3}" text)
set(path)
foreach(i RANGE 4 ${CMAKE_ARGC})
    if(i LESS CMAKE_ARGC)
        list(APPEND path "${CMAKE_ARGV${i}}")
    endif()
endforeach()
string(JSON type TYPE "${text}" ${path})
if(type STREQUAL "ARRAY")
    string(JSON value LENGTH "${text}" ${path})
else()
    string(JSON value GET "${text}" ${path})
endif()
message("${value}")
END
json() { "$cmake" -P json.cmake "$@" 2>&1; }

# ---- The bars hold ----

"$program" --check --json out/costs.json >stdout 2>stderr
code=$?
if [ $code -ne 0 ] && grep -q 'RADV driver is not installed' stderr; then
    printf 'skipped: %s\n' "$(cat stderr)"
    exit 77
fi
if [ $code -ne 0 ]; then
    fail "exit code $code: $(cat stderr)"
    finish
fi
[ ! -s stderr ] || fail "said on stderr: $(cat stderr)"
bars=$(grep -c '^held: .* instructions, at most [0-9]* (' stdout)
[ "$bars" -eq 8 ] || fail "$bars bars held"
grep '^NOT held\|^no row' stdout && fail "the line above, and exit code 0"

shaders=$(json out/costs.json shaders)
[ "$shaders" -ge 80 ] || fail "JSON has shaders: $shaders"
rows=$(grep -c '^| [a-zA-Z ]*, .* | *-*[0-9]* | *-*[0-9]* | *-*[0-9]* | *[0-9]* | *[0-9]* |$' stdout)
[ "$rows" -eq $((3 * shaders)) ] || fail "$rows rows for $shaders shaders on three families"
[ "$(json out/costs.json left_out)" = 0 ] || fail "JSON has functions that were left out"
[ "$(json out/costs.json checks 0 held)" = ON ] || fail "JSON has not held: $(json out/costs.json checks 0 held)"
first=$(json out/costs.json shaders 0 navi21 inverse_throughput)
grep -q "^| yardstick, Lengyel, listing 5.1 *| *$(json out/costs.json shaders 0 navi21 instructions) | *$first |" stdout ||
    fail "JSON and table differ: $first"
for family in navi21 vega10 navi10; do
    for figure in instructions inverse_throughput latency vgprs sgprs; do
        [ "$(json out/costs.json empty $family $figure)" -gt 0 ] || fail "JSON, empty shader, $family, $figure"
        [ "$(json out/costs.json shaders 0 $family $figure)" -gt 0 ] || fail "JSON, $family, $figure"
    done
done

# ---- They can fail, and no function can be forgotten ----

cp -r "$snippets" in/slow
for file in in/slow/*.h; do
    sed 's/inversesqrt(/1.0f \/ tan(/g' "$file" >in/file
    mv in/file "$file"
done
"$program" --check --snippets in/slow >stdout 2>stderr
code=$?
[ $code -eq 1 ] || fail "exit code $code with slow snippets"
grep -q '^NOT held: tangent volume, .*, at most 34 (tangent volume, octant, soft)$' stdout || fail "$(tail -n 12 stdout)"
[ "$(cat stderr)" = "shader_cost: $(grep -c '^NOT held: ' stdout) bars did not hold" ] || fail "$(cat stderr)"

cp -r "$snippets" in/more
printf '\nBUMPSHADOW_FUNCTION float bumpshadow_new(float v) { return v; }\n' >>in/more/bearing.h
refuse 1 'no row has the function bumpshadow_new' --check --snippets in/more
printf 'BUMPSHADOW_FUNCTION float bumpshadow_wrong(float v) { return w; }\n' >>in/more/shadow.h
sed 's/bumpshadow_shadow_hard/bumpshadow_wrong_name/' in/more/shadow.h >in/file
mv in/file in/more/shadow.h
refuse 1 'there is no snippet bumpshadow_shadow_hard' --snippets in/more

run --show 'tangent volume, octant, soft'
grep -q 'float bumpshadow_bearing_octant(vec2 v)' stdout || fail "--show: $(cat stdout)"
grep -q 'bumpshadow_bearing_cubic' stdout && fail "--show: more than is called"
"$program" --help >stdout 2>stderr || fail "--help ends with $?"

# ---- Bad input ----

refuse 1 'there is no Vulkan driver manifest out/none.json' --icd out/none.json
refuse 1 'no Vulkan driver loads from in/block.png' --icd in/block.png --json out/bad.json
refuse 1 'cannot run out/none' --glslang out/none --json out/bad.json
refuse 1 'cannot read out/none/shader.hpp' --snippets out/none
refuse 1 'cannot write out/none/costs.json' --json out/none/costs.json
refuse 1 '--show: no shader is named nonsense' --show nonsense
refuse 2 'extra' extra
refuse 2 '--icd' --icd

[ -z "$(ls tmp)" ] || fail "temporary files left: $(ls tmp)"
finish
