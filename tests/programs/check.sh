# Read by the tests: sh TEST.sh PROGRAM IMAGES WORK_DIR
set -u
program=$1 images=$2 work=$3
rm -rf "$work"
mkdir -p "$work"
cd "$work" || exit 1
"$images" make in || exit 1
mkdir out
failures=0
# Windows has neither limits of file sizes nor signals from outside.
posix=yes
# shellcheck disable=SC2034 # for the scripts that read this
[ "${BUMPSHADOW_TESTED_SYSTEM-}" != Windows ] || posix=

fail() {
    failures=$((failures + 1))
    printf 'FAILED: %s\n' "$*"
}

# Files in out/, on one line.
left() { (cd out && find . ! -name . | sort | tr '\n' ' '); }

# run ARGUMENTS: has to end with 0 and say nothing on stderr.
run() {
    "$program" "$@" >stdout 2>stderr
    code=$?
    [ $code -eq 0 ] || fail "exit code $code: $*: $(cat stderr)"
    [ ! -s stderr ] || fail "said on stderr: $*: $(cat stderr)"
}

# refuse CODE TEXT ARGUMENTS: has to end with that code, say one line on stderr that contains the text, nothing on
# stdout, and leave out/ as it was.
refuse() {
    wanted=$1 text=$2
    shift 2
    before=$(left)
    "$program" "$@" >stdout 2>stderr
    code=$?
    [ $code -eq "$wanted" ] || fail "exit code $code, not $wanted: $*"
    grep -qF -e "$text" stderr || fail "does not say '$text': $*: $(cat stderr)"
    [ "$(wc -l <stderr)" -eq 1 ] || fail "says more than one line: $*: $(cat stderr)"
    [ ! -s stdout ] || fail "said on stdout: $*: $(cat stdout)"
    [ "$(left)" = "$before" ] || fail "left files behind: $*: $(left)"
}

# floats FILE WANTED...: the little-endian floats of a file, to a thousandth.
floats() {
    file=$1
    shift
    found=$(od -An -v -tf4 "$file" | tr '\n' ' ')
    printf '%s\n%s\n' "$found" "$*" | awk '
        NR == 1 { n = split($0, found) }
        NR == 2 { if (NF != n) exit 1
                  for (i = 1; i <= n; ++i) { d = found[i] - $i; if (d > 0.001 || d < -0.001) exit 1 } }' ||
        fail "$file holds $found instead of $*"
}

bytes() { wc -c <"$1" | tr -d ' '; }

finish() {
    find . -name '*.part' | grep -q . && fail "parts left: $(find . -name '*.part')"
    [ $failures -eq 0 ] || exit 1
    echo "all passed"
}
