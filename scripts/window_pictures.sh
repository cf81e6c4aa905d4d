#!/bin/bash
# Takes the screenshots of docs/window.md: the program under Xvfb, played by xdotool. Needs xvfb, xdotool and
# imagemagick (on Debian: apt-get install xvfb xdotool imagemagick).
#
#   scripts/window_pictures.sh [PROGRAM] [FOLDER]
set -eu
program=${1:-target/release/nocturne}
pictures=${2:-docs/window}
folder=$(mktemp -d)
trap 'kill $(jobs -p) 2> /dev/null; rm -rf "$folder"' EXIT
Xvfb -displayfd 3 -screen 0 1280x720x24 -nolisten tcp 3> "$folder/display" > /dev/null 2>&1 &
until [ -s "$folder/display" ]; do sleep 0.1; done
DISPLAY=:$(cat "$folder/display")
export DISPLAY NODEVICE_SELECT=1 NOCTURNE_STATE=

begin() {
    "$program" --full-screen "$@" &
    window=$!
    sleep 8
}
end() {
    import -window root -define png:compression-level=9 "$pictures/$1.png"
    kill $window
    wait $window 2> /dev/null || true
}
press() {
    for key in "$@"; do
        xdotool key "$key"
        sleep 0.5
    done
}

begin --scene docs/window/evening.toml
press c v
sleep 3
end evening

begin --scene docs/window/evening.toml
press F3
xdotool type jup
press Return
sleep 4
end find_jupiter

begin --scene docs/window/evening.toml
press F3
xdotool type moon
press Return
sleep 4
end moonrise

begin --place Flagstaff --at "2026-02-20 19:15"
press F5
sleep 1
# The button beside "lunar eclipse".
xdotool mousemove "${ECLIPSE_X:-1050}" "${ECLIPSE_Y:-474}" click 1
sleep 8
press l Escape
for _ in 1 2 3 4 5 6 7 8 9 10; do press Prior; done
sleep 5
end eclipse

export NOCTURNE_STATE=$folder/state.toml
cp docs/window/everything.toml "$NOCTURNE_STATE"
begin
end everything
