#!/bin/sh
# sh wine.sh PROGRAM.exe [ARGUMENT...]: runs a Windows program, silently but for what it says itself. The Windows that it
# sees is kept in the folder BUMPSHADOW_WINE, build/wine if that is not set.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
WINEPREFIX=${BUMPSHADOW_WINE:-$root/build/wine}
WINEDEBUG=-all
WINEDLLOVERRIDES='mscoree,mshtml,winemenubuilder.exe='
export WINEPREFIX WINEDEBUG WINEDLLOVERRIDES
# Debian's script `wine` says on every run that 32-bit programs are not supported.
for wine in wine64 /usr/lib/wine/wine64 wine; do
    if command -v "$wine" >/dev/null 2>&1; then
        mkdir -p "$(dirname "$WINEPREFIX")"
        exec "$wine" "$@"
    fi
done
echo 'wine.sh: no Wine here (Debian, Ubuntu: wine64)' >&2
exit 127
