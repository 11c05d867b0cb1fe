# sh full_disk.sh PROGRAMS_FOLDER IMAGES WORK_DIR
# Every program that writes, where the disk is full or may not be written: an exit code, one line that names the file,
# and nothing left behind. What bake.sh and demo.sh try is not repeated: a target that is a folder, standard output of
# bake, the size limit of demo.
# shellcheck disable=SC2086 # lists of words
# shellcheck source=tests/programs/check.sh
. "$(dirname "$0")/check.sh"
programs=$program
map=in/block.png
echo '{}' >scene.json
# What programs put aside while they work; whoever runs them.
mkdir tmp
chmod 1777 tmp
TMPDIR=$work/tmp
export TMPDIR

# refuses PROGRAM TEXT ARGUMENTS: as refuse does, for a program by name; standard output does not matter, since programs
# that measure print first. $limit: blocks of 512 bytes that a file may have; $user: who runs it.
limit='' user=''
refuses() {
    name=$1 text=$2
    shift 2
    [ -x "$programs/$name" ] || return 0
    before=$(left)
    (
        [ -z "$limit" ] || ulimit -f "$limit"
        # In a shell of its own, which says what ended it.
        exec $user "$programs/$name" "$@" >stdout 2>stderr
    )
    code=$?
    [ $code -eq 1 ] || fail "exit code $code, not 1: $name $*"
    grep -qF -e "$text" stderr || fail "does not say '$text': $name $*: $(cat stderr)"
    # Programs that show how far they are write \r.
    [ "$(tr '\r' '\n' <stderr | grep -c "^$name: ")" -eq 1 ] || fail "says more than one line: $name $*: $(cat stderr)"
    [ "$(left)" = "$before" ] || fail "left files behind: $name $*: $(left)"
}

# writers TEXT FOLDER: each program that writes files, into a folder.
writers() {
    refuses bake "$1 $2/a.f32" $map -o "$2/a.f32" --bearings 32
    refuses bake "$1 $2/a.png" in/bumps.png -o "$2/a.png"
    refuses bake "$1 $2/a" in/bumps.png -o "$2/a.dds" --encoding sine
    refuses bake "$1 $2/a.raw" in/bumps.png -o "$2/a.raw" --encoding tangent
    refuses shade "$1 $2/a.png" in/bumps.png -o "$2/a.png"
    refuses demo "$1 $2/" in/bumps.png -o "$2"
    refuses plan "$1 $2/a.json" scene.json in/bumps.png --json "$2/a.json"
    refuses report "$2/" in/bumps.png -o "$2" --only bake --quick --repeats 1
    refuses benchmark "$1 $2/a.json" $map --repeats 1 --sample 1 --json "$2/a.json"
    # These write to temporary folders of their own first.
    refuses encodings 'cannot write' in/bumps.png --repeats 1 --texels 1 --json "$2/a.json"
}

# ---- A limit on the size of files, which is a full disk without any rights: the signal is a failed write ----

limit=1
mkdir out/full
writers 'cannot write' out/full
refuses shader_cost 'cannot write' --json out/full/a.json  # once, since it takes long
[ -z "$(ls out/full)" ] || fail "left after a full disk: $(ls out/full)"
# What was there before stays.
for file in a.f32 a.png a.dds a.1.dds a.raw a.json; do echo old >"out/full/$file"; done
writers 'cannot write' out/full
for file in out/full/*; do [ "$(cat "$file")" = old ] || fail "$file is gone"; done
limit=''

# ---- Standard output that is full ----

if [ -w /dev/full ]; then
    for arguments in 'snippets' 'snippets --list' "benchmark $map --repeats 1 --sample 1" \
        "encodings in/bumps.png --repeats 1 --texels 1"; do
        name=${arguments%% *}
        [ -x "$programs/$name" ] || continue
        "$programs/"$arguments >/dev/full 2>stderr
        code=$?
        [ $code -eq 1 ] || fail "exit code $code, not 1: $arguments >/dev/full"
        [ "$(tr '\r' '\n' <stderr | grep -c "^$name: ")" -eq 1 ] || fail "$arguments >/dev/full: $(cat stderr)"
    done
else
    echo "skipped: no /dev/full here"
fi

# ---- A link is not replaced by a file: what it leads to is written ----

ln -s real.f32 out/link.f32
refuses bake 'cannot write out/link.f32: No such file' $map -o out/link.f32
echo before >out/real.f32
"$programs/bake" $map -o out/link.f32 >/dev/null || fail 'bake through a link'
"$programs/bake" $map -o out/straight.f32 >/dev/null || fail bake
[ -L out/link.f32 ] || fail 'a link was replaced'
cmp out/real.f32 out/straight.f32 || fail 'other bytes through a link'
rm out/link.f32 out/real.f32 out/straight.f32

# ---- A target that is no file is not replaced by one. A pipe stands for devices, which root could lose ----

mkfifo out/pipe.json out/pipe.f32 out/pipe.png
refuses bake 'cannot write out/pipe.f32: it is no file' $map -o out/pipe.f32
refuses shade 'cannot write out/pipe.png: it is no file' in/bumps.png -o out/pipe.png
refuses plan 'cannot write out/pipe.json: it is no file' scene.json in/bumps.png --json out/pipe.json
refuses benchmark 'cannot write out/pipe.json: it is no file' $map --repeats 1 --sample 1 --json out/pipe.json
for pipe in out/pipe.*; do [ -p "$pipe" ] || fail "$pipe is no pipe any more"; done
rm out/pipe.*

# ---- A folder that may not be written ----

mkdir out/closed
echo old >out/closed/a.f32
chmod 555 out/closed
if [ "$(id -u)" -ne 0 ]; then
    user='env'
elif command -v setpriv >/dev/null 2>&1 &&
    setpriv --reuid=65534 --regid=65534 --clear-groups sh -c "cat '$map' && cat '$programs/bake'" >/dev/null 2>&1; then
    user='setpriv --reuid=65534 --regid=65534 --clear-groups'
fi
if [ -n "$user" ]; then
    writers 'cannot write' out/closed
    # Whose measuring takes minutes, elsewhere.
    refuses plan 'cannot write out/closed/a.json' --proof --json out/closed/a.json
    [ "$(cat out/closed/a.f32)" = old ] || fail "a file of a closed folder is gone"
else
    echo "skipped: root may write everywhere, and there is no setpriv that can read $programs as somebody else"
fi
user=''

# ---- A disk with no room left ----

mkdir out/disk
if mount -t tmpfs -o size=64k none out/disk 2>/dev/null; then
    trap 'umount out/disk' EXIT
    head -c 100000 /dev/zero >out/disk/filler 2>/dev/null
    writers 'cannot write' out/disk
    [ "$(ls out/disk)" = filler ] || fail "left on a full disk: $(ls out/disk)"
else
    echo "skipped: may not mount a small disk"
fi

chmod 755 out/closed
[ -z "$(ls tmp)" ] || fail "temporary files left: $(ls tmp)"
finish
