#!/bin/sh
# Draws the Moon of the same instants and places with this program and with Stellarium, measures both,
# and writes pictures to docs/moon/side_by_side/ and tables into docs/moon_side_by_side.md.
# Needs a built program (NOCTURNE=path, by default target/release/nocturne); installs the rest if this
# user may, and names it otherwise. Three minutes on two cores; `--keep` takes what Stellarium drew the
# last time, and half as long.
set -eu
cd "$(dirname "$0")/.."
export NODEVICE_SELECT="${NODEVICE_SELECT:-1}"
nocturne="${NOCTURNE:-target/release/nocturne}"
venv=target/side_by_side/venv

if [ ! -x "$nocturne" ]; then
    echo "There is no program at $nocturne: run cargo build --release first." >&2
    exit 1
fi
scripts/prepare.sh stellarium
if ! "$venv/bin/python" -c "import numpy, PIL, OpenEXR, ephem" 2>/dev/null; then
    python3 -m venv "$venv"
    "$venv/bin/pip" install --quiet --only-binary :all: numpy pillow OpenEXR ephem
fi
exec "$venv/bin/python" scripts/side_by_side.py --nocturne "$nocturne" "$@"
