#!/bin/sh
# sh wine.sh PROGRAM.exe [ARGUMENT...]: runs a Windows program, silently but for what it says itself. The Windows that it
# sees is kept in the folder BUMPSHADOW_WINE, build/wine if that is not set.
# sh wine.sh --start: makes that folder, and keeps Wine running for a minute after each program, which saves seconds.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
LC_ALL=C.UTF-8  # or names would lose letters on their way to the program
WINEPREFIX=${BUMPSHADOW_WINE:-$root/build/wine}
WINEDEBUG=-all
WINEDLLOVERRIDES='mscoree,mshtml,winemenubuilder.exe='
export LC_ALL WINEPREFIX WINEDEBUG WINEDLLOVERRIDES

# find_program NAME...: the first that is a program; Debian keeps those of 64 bits beside the path, and its script `wine`
# says on every run that 32-bit programs are not supported.
find_program() {
    for name; do
        if command -v "$name" >/dev/null 2>&1; then
            echo "$name"
            return 0
        fi
    done
    echo "wine.sh: no Wine here (Debian, Ubuntu: wine64)" >&2
    exit 127
}
wine=$(find_program wine64 /usr/lib/wine/wine64 wine)
if [ "$1" != --start ]; then exec "$wine" "$@"; fi

mkdir -p "$WINEPREFIX"
server=$(find_program wineserver64 /usr/lib/wine/wineserver64 wineserver)
"$server" -p60 || [ $? -eq 2 ]  # 2: it runs already
"$wine" wineboot --init >/dev/null 2>&1
