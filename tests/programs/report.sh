# sh report.sh REPORT IMAGES WORK_DIR
# shellcheck disable=SC2086 # lists of words
# shellcheck source=tests/programs/check.sh
. "$(dirname "$0")/check.sh"

unset BUMPSHADOW_HEIGHT_MAPS
quick='--only bake --quick --repeats 1'

# has_all FOLDER: what every run leaves behind.
has_all() {
    for file in report.csv report.json report.md index.html plots/bake.gp plots/bake.dat; do
        [ -s "$1/$file" ] || fail "$1/$file is missing"
    done
    # shellcheck disable=SC2013 # names without blanks
    for file in $(grep -o 'src="[^"]*"' "$1/index.html" | sed 's/src="//; s/"//'); do
        [ -s "$1/$file" ] || fail "$1/index.html shows $file, which is missing"
    done
    grep -q '://' "$1/index.html" && fail "$1/index.html needs the network"
}

# check FOLDER EXPRESSION: what Python says of report.json, as `report`, and of the lines of report.csv, as `lines`.
check() {
    [ -n "$python" ] || return 0
    "$python" - "$1" "$2" <<'END' || fail "$1: not so: $2"
import csv, json, sys
report = json.load(open(sys.argv[1] + "/report.json"))
lines = list(csv.DictReader(line for line in open(sys.argv[1] + "/report.csv", newline="") if line[0] != "#"))
records, columns = report["records"], [column["name"] for column in report["columns"]]
numbers = [column["name"] for column in report["columns"] if column["kind"] != "text"]
sys.exit(0 if eval("(" + sys.argv[2] + ")") else 1)
END
}
python=$(command -v python3) || echo "skipped: the content of report.json and report.csv (no python3)"

# ---- The schema ----

run in/hill.png -o out/hill $quick --seed 7
has_all out/hill
check out/hill 'report["schema"] == {"name": "bumpshadow-report", "version": 1}'
check out/hill 'all(key in report["run"] for key in "machine cores compiler flags simd_width version date".split())'
check out/hill '(report["run"]["seed"], report["run"]["repeats"], report["run"]["quick"]) == (7, 1, True)'
check out/hill 'report["run"]["complete"] and "partial" not in report["run"]'
check out/hill '[(m["name"], m["width"], m["height"], m["height_scale"]) for m in report["maps"]] ==
    [("hill", 64, 64, 4)]'
check out/hill 'report["skipped_maps"] == [] and [s["state"] for s in report["sections"]] == ["complete"]'
check out/hill 'all(set(column) == {"name", "unit", "kind", "meaning"} for column in report["columns"])'
check out/hill 'all(c["kind"] in ("text", "set-up", "count", "absolute time", "ratio", "error")
    for c in report["columns"])'
check out/hill '{c["name"]: c["kind"] for c in report["columns"]}["bake_ns"] == "absolute time"'
check out/hill 'len(set(columns)) == len(columns) and list(lines[0]) == columns'
check out/hill 'len(records) == len(lines) > 3 and all(set(r) <= set(columns) for r in records)'
check out/hill 'len({(r["section"], r["map"], r["name"]) for r in records}) == len(records)'
# The same text and numbers in both files; what a record does not have is empty.
check out/hill 'all(str(r.get(c, "")) == l[c] for r, l in zip(records, lines) for c in columns if c not in numbers)'
check out/hill 'all((c in r) == (l[c] != "") and float(r.get(c, 0)) == float(l[c] or 0)
    for r, l in zip(records, lines) for c in numbers)'
# A front: by growing x and falling y, and no record beats a member.
check out/hill 'all(a["x"] < b["x"] and a["y"] > b["y"] for f in report["fronts"]
    for a, b in zip(f["members"], f["members"][1:]))'
check out/hill '[f["plot"] for f in report["fronts"]] == ["bake"]'
check out/hill 'not any(r["bake_ns"] < m["x"] and r["error_mean"] < m["y"] for m in report["fronts"][0]["members"]
    for r in records if "error_mean" in r and r["threads"] == 1 and r["radius"] == "inf")'
if command -v gnuplot >/dev/null; then
    grep -q '<svg' out/hill/plots/bake.svg || fail "plots/bake.svg is no picture"
else
    echo "skipped: pictures of the plots (no gnuplot)"
fi

# All that is not timed is the same on every run with one seed.
run in/hill.png -o out/again $quick --seed 7
if [ -n "$python" ]; then
    for folder in hill again; do
        "$python" -c 'import csv, sys
for line in csv.DictReader(open(sys.argv[1])):
    print([line[column] for column in line if column not in ("bake_ns", "bake_ratio")])' out/$folder/report.csv >$folder
    done
    cmp -s hill again || fail "two runs with one seed differ"
fi

# ---- Several maps: their mean, one that cannot be read, folders ----

"$program" in/hill.png in/cut.png in/block.png -o out/three $quick --height-scale 6 >stdout 2>stderr
code=$?
[ $code -eq 3 ] || fail "a broken map among good ones: exit code $code"
grep -q 'skipped: .*in/cut.png: broken PNG' stderr || fail "does not name the broken map: $(cat stderr)"
[ "$(wc -l <stderr)" -eq 1 ] || fail "a broken map among good ones: $(cat stderr)"
has_all out/three
for file in report.json report.md index.html; do
    grep -q 'in/cut.png' out/three/$file || fail "$file does not say what was skipped"
done
check out/three '[(s["source"], "broken PNG" in s["reason"]) for s in report["skipped_maps"]] == [("in/cut.png", True)]'
check out/three '[(m["name"], m["height_scale"]) for m in report["maps"]] == [("hill", 6), ("block", 6)]'
check out/three 'any(r["map"] == "mean" for r in records)'
check out/three 'all(abs(mean["error_mean"] - sum(errors) / 2) < 1e-4
    for mean in records if mean["map"] == "mean" and "error_mean" in mean
    for errors in [[r["error_mean"] for r in records if r["name"] == mean["name"] and r["map"] != "mean"]])'

mkdir maps listed
cp in/hill.png in/block.png maps
cp in/hill.png listed/h.png
printf 'file\theight_scale\ttexel_size\ttiles\nh.png\t9\t2 1\tno\n' >listed/MANIFEST.tsv
run maps listed -o out/folders $quick
check out/folders '[(m["name"], m["height_scale"], m["edge"]) for m in report["maps"]] ==
    [("block", 2, "repeat"), ("hill", 4, "repeat"), ("h", 9, "clamp")]'
check out/folders 'report["maps"][2]["texel_size"] == [2, 1]'

# ---- Without gnuplot ----

PATH=$work/nothing "$program" in/hill.png -o out/hill $quick >stdout 2>stderr || fail "without gnuplot: exit code $?"
grep -q 'gnuplot is not in PATH' stdout || fail "does not say that gnuplot is missing: $(cat stdout)"
grep -q 'gnuplot is not in PATH' out/hill/report.md || fail "report.md does not say that gnuplot is missing"
[ ! -e out/hill/plots/bake.svg ] || fail "a plot of an earlier run is left"
has_all out/hill

# ---- Ended from outside ----

# A shell lets its background jobs ignore SIGINT; env gives the program the default again where it can.
if env --default-signal=INT true 2>/dev/null; then
    for times in once twice; do
        rm -f stdout
        env --default-signal=INT "$program" in/bumps.png -o out/$times --only bake >stdout 2>stderr &
        running=$!
        # The first line is printed when Ctrl-C is cared for.
        tries=0
        while [ ! -s stdout ] && [ $tries -lt 200 ]; do
            tries=$((tries + 1))
            sleep 0.05
        done
        kill -s INT $running
        [ $times = once ] || kill -s INT $running
        { wait $running; } 2>/dev/null
        code=$?
        [ $code -eq 130 ] || fail "SIGINT $times: exit code $code"
    done
    for file in report.csv report.json report.md index.html; do
        grep -q '[pP]artial\|PARTIAL' out/once/$file || fail "$file is not marked as partial"
    done
    [ "$(head -c 9 out/once/report.csv)" = "# partial" ] || fail "report.csv: $(head -n 1 out/once/report.csv)"
    check out/once 'not report["run"]["complete"] and report["run"]["partial"] == "interrupted"'
    check out/once '[s["state"] for s in report["sections"]] == ["partial: interrupted"]'
else
    echo "skipped: SIGINT (env has no --default-signal)"
fi

# ---- Bad input ----

"$program" --help >stdout 2>stderr || fail "--help ends with $?"
grep -qF 'Exit code' stdout || fail "--help does not say what exit codes mean"

rm -rf out
mkdir out
echo file >out/file
refuse 2 '--output is required' in/hill.png
refuse 2 '--only: nonsense is none of bake' in/hill.png -o out/a --only nonsense
refuse 2 '--seed: -1 is given' in/hill.png -o out/a --seed -1
refuse 2 '--repeats: 0 is given' in/hill.png -o out/a --repeats 0
refuse 2 '--height-scale: nan is given' in/hill.png -o out/a --height-scale nan
refuse 1 'in/none.png: No such file' in/none.png -o out/a
refuse 1 'in/cut.png: broken PNG' in/cut.png -o out/a/b
mkdir empty
refuse 1 'no PNG files in folder empty' empty -o out/a
"$program" in/cut.png in/none.png -o out/a >stdout 2>stderr
code=$?
[ $code -eq 1 ] || fail "no map can be read: exit code $code"
grep -q 'none of the 2 height maps' stderr || fail "no map can be read: $(cat stderr)"
for map in in/cut.png in/none.png; do
    grep -q "$map" stderr || fail "does not name $map: $(cat stderr)"
done
[ "$(left)" = './file ' ] || fail "no map can be read: left $(left)"

# Known before any work: nothing has been printed.
refuse 1 'out/file/a' in/hill.png -o out/file/a
refuse 1 'out/file' in/hill.png -o out/file
mkdir -p out/taken/report.csv
refuse 1 'out/taken/report.csv: Is a directory' in/hill.png -o out/taken
rm -r out/taken
mkdir -p out/closed
chmod a-w out/closed
if (: >out/closed/probe) 2>/dev/null; then
    rm -f out/closed/probe
    echo "skipped: a folder without permission to write (root may write everywhere)"
else
    refuse 1 'out/closed' in/hill.png -o out/closed
fi

finish
