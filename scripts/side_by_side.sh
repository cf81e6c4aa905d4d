#!/bin/sh
# Draws the Moon of the same instants and places with this program and with Stellarium, measures both,
# and writes pictures to docs/moon/side_by_side/ and tables into docs/moon_side_by_side.md.
# Needs the Debian packages below (installs them if this user may) and a built program
# (NOCTURNE=path, by default target/release/nocturne). About three minutes.
set -eu
cd "$(dirname "$0")/.."
export NODEVICE_SELECT="${NODEVICE_SELECT:-1}"
nocturne="${NOCTURNE:-target/release/nocturne}"
packages="stellarium xvfb python3-venv"
python="target/side_by_side/venv/bin/python"

if [ ! -x "$nocturne" ]; then
    echo "There is no program at $nocturne: run cargo build --release first." >&2
    exit 1
fi
if ! command -v stellarium >/dev/null 2>&1 || ! command -v Xvfb >/dev/null 2>&1; then
    if ! command -v apt-get >/dev/null 2>&1 || [ "$(id -u)" != 0 ]; then
        echo "Please install $packages (on Debian: apt-get install $packages)." >&2
        exit 1
    fi
    echo "Installing $packages." >&2
    apt-get update -qq >/dev/null
    # shellcheck disable=SC2086  # the packages are words
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $packages >/dev/null
fi
if ! "$python" -c "import numpy, PIL, OpenEXR, ephem" 2>/dev/null; then
    python3 -m venv target/side_by_side/venv
    "$python" -m pip install --quiet --only-binary :all: numpy pillow OpenEXR ephem
fi
exec "$python" scripts/side_by_side.py --nocturne "$nocturne" "$@"
