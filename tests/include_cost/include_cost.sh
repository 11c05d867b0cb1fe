# sh include_cost.sh CXX INCLUDE WORK_DIR [FOLDER OF GLM...]
# shellcheck disable=SC2086 # flags is a list of words
# What it costs to include each header of the library, and that none includes what the design does not let it.
set -u
LC_ALL=C
export LC_ALL
compiler=$1 include=$2 work=$3
here=$(cd "$(dirname "$0")" && pwd)
shift 3
flags=
for folder; do flags="$flags -I$folder"; done

# Seconds of processor time that a compiler takes: those of a loaded machine, too.
seconds() {
    ("$compiler" -std=c++20 "-I$include" $flags "$@" >/dev/null || exit 1; times) | tail -n 1 |
        sed 's/m/ /g; s/s/ /g' | awk '{ printf "%.3f\n", 60 * ($1 + $3) + $2 + $4 }'
}
rm -rf "$work"
mkdir -p "$work"
library=$include/bumpshadow
failures=0
fail() {
    failures=$((failures + 1))
    printf 'FAILED: %s\n' "$*"
}
headers() { (cd "$library" && find . "$@" | sed 's|^\./||' | sort); }
# "FROM TO" for each header of the library that a header includes.
(cd "$library" && grep -rE '^ *# *include *[<"]' --include='*.hpp' --include='*.h' .) |
    sed -n 's|^\./\([^:]*\):.*[<"]bumpshadow/\([^>"]*\)[>"].*|\1 \2|p' >"$work/edges"

# ---- Directions ----

[ "$(wc -l <"$work/edges")" -gt 100 ] || fail "only $(wc -l <"$work/edges") includes were found"
awk -f "$here/directions.awk" "$here/allowed.txt" "$work/edges" >"$work/wrong"
while IFS= read -r line; do fail "$line"; done <"$work/wrong"
# The shader sources are pasted: they include nothing.
for header in $(headers -name '*.h'); do
    if grep -q '^ *# *include' "$library/$header"; then fail "$header includes something"; fi
done
# The rule can fail.
printf '%s\n' 'horizon/sweep.hpp encode/slices.hpp' 'horizon/sweep.hpp horizon/cascade.hpp' \
    'horizon/sweep.hpp horizon/cascade_near.hpp' 'status.hpp plan.hpp' 'measure/sample.hpp plan/scene.hpp' >"$work/bad"
[ "$(awk -f "$here/directions.awk" "$here/allowed.txt" "$work/bad" | wc -l)" -eq 5 ] ||
    fail "wrong includes are not found"

# ---- Lines of each header, and seconds of those that are for everyone ----

(
    awk '$1 == "bumpshadow.hpp" { print $2 }' "$work/edges"
    printf '%s\n' bumpshadow.hpp plan.hpp plan/shader.hpp shader/snippets.hpp
) | sort -u >"$work/timed"
headers -name '*.hpp' ! -name stb_blocks.hpp >"$work/headers"
# Lines of each header that are left after preprocessing, blank ones aside, and of all that it includes of the library.
sed 's|.*|#include <bumpshadow/&>|' "$work/headers" >"$work/unused.cpp"
"$compiler" -std=c++20 "-I$include" $flags -E "$work/unused.cpp" | tr -d '\r' | awk '
    /^# [0-9]+ "/ {
        split($0, part, "\"")
        own = sub(/.*\/bumpshadow\//, "", part[2]) ? part[2] : ""
        next
    }
    own != "" && NF > 0 { ++lines[own] }
    END { for (own in lines) print own, lines[own] }' >"$work/lines"
awk '
    function visit(header, i) {
        if (header in seen) return 0
        seen[header]
        sum += lines[header]
        for (i = 1; i <= count[header]; ++i) visit(to[header, i])
    }
    FILENAME ~ /lines$/ { lines[$1] = $2; next }
    FILENAME ~ /edges$/ { to[$1, ++count[$1]] = $2; next }
    {
        split("", seen)
        sum = 0
        visit($1)
        print $1, sum
    }' "$work/lines" "$work/edges" "$work/headers" | sort >"$work/own"

# Two at a time.
for part in 0 1; do
    awk -v part=$part 'NR % 2 == part' "$work/timed" | while IFS= read -r header; do
        printf '#include <bumpshadow/%s>\n' "$header" >"$work/alone.$part.cpp"
        time=$(seconds -fsyntax-only "$work/alone.$part.cpp")
        printf '%s %s\n' "$header" "${time:-failed}" >>"$work/times.$part"
    done &
done
wait
cat "$work/times.0" "$work/times.1" | sort >"$work/times"
join -a 1 -e - -o 0,1.2,2.2 "$work/own" "$work/times" >"$work/rows"
echo 'own lines after preprocessing; seconds of processor time for -fsyntax-only, with GLM and the standard library,'
echo 'where a header is for everyone and no part of another:'
awk '{ printf "%8d %8s  %s\n", $2, $3, $1 }' "$work/rows"
sed -n 's/ .* failed$//p' "$work/rows" >"$work/broken"
while IFS= read -r header; do fail "$header does not compile alone"; done <"$work/broken"
[ "$(wc -l <"$work/times")" -eq "$(wc -l <"$work/timed")" ] || fail "headers are missing in the table"
awk '{ all += $2 } END { exit all < 1000 }' "$work/rows" || fail "the headers have next to no lines"
[ "$(wc -l <"$work/rows")" -eq "$(wc -l <"$work/headers")" ] || fail "headers are missing in the table"

# ---- All of it beside GLM and the standard library alone ----

# What the library's headers include of others, but xsimd, which is an option.
(cd "$library" && grep -rhE '^#include <' --include='*.hpp' .) | tr -d '\r' |
    grep -vE '<(bumpshadow/|xsimd/|stb)' | sort -u >"$work/others.cpp"
printf '#include <bumpshadow/bumpshadow.hpp>\n' >"$work/all.cpp"
three() { for _ in 1 2 3; do seconds -fsyntax-only "$work/$1.cpp"; done | sort -n >"$work/$1.seconds"; }
three all &
three others
wait
all=$(sed -n 2p "$work/all.seconds") others=$(sed -n 2p "$work/others.seconds")
verdict=$(awk -v a="$all" -v o="$others" 'BEGIN {
    printf "bumpshadow.hpp: %.2f s, GLM and the standard library alone %.2f s: %.2f s beyond them (1 s is %s)\n",
        a, o, a - o, a - o < 1 ? "held" : "NOT held"
    if (!(a > 0 && o > 0 && a < 4 * o)) print "too long"
}')
printf '%s\n' "$verdict"
case $verdict in *'too long'*) fail "bumpshadow.hpp takes four times as long as what it is made of" ;; esac

# ---- Everything included and nothing used: an object without symbols ----

if ! command -v nm >/dev/null 2>&1; then
    echo 'skipped: whether unused headers leave symbols: no nm here'
else
    if "$compiler" -std=c++20 "-I$include" $flags -c "$work/unused.cpp" -o "$work/unused.o"; then
        nm -C "$work/unused.o" >"$work/symbols"
        echo "symbols of everything included and nothing used: $(wc -l <"$work/symbols")"
        if grep bumpshadow "$work/symbols"; then fail "unused headers leave symbols"; fi
        # The check can fail.
        printf '%s\n' '#include <bumpshadow/bearing.hpp>' \
            'glm::dvec2 (*name)(double) = bumpshadow::exact_direction<double>;' >"$work/used.cpp"
        "$compiler" -std=c++20 "-I$include" $flags -c "$work/used.cpp" -o "$work/used.o"
        nm -C "$work/used.o" | grep -q bumpshadow || fail "symbols are not found"
    else
        fail "all headers together do not compile"
    fi
fi

[ $failures -eq 0 ] || printf '%s failures\n' "$failures"
[ $failures -eq 0 ]
