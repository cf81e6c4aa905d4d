#!/bin/bash
# What the window costs on a software driver: CPU milliseconds of all threads for a presented frame, seconds to
# the first sky, resident memory, and what a still sky costs. Needs xvfb (on Debian: apt-get install xvfb).
#
#   scripts/window_cost.sh [PROGRAM] [SECONDS]
set -eu
program=${1:-target/release/nocturne}
seconds=${2:-10}
folder=$(mktemp -d)
trap 'kill $(jobs -p) 2> /dev/null; rm -rf "$folder"' EXIT
Xvfb -displayfd 3 -screen 0 1280x720x24 -nolisten tcp 3> "$folder/display" > /dev/null 2>&1 &
until [ -s "$folder/display" ]; do sleep 0.1; done
DISPLAY=:$(cat "$folder/display")
export DISPLAY NODEVICE_SELECT=1 NOCTURNE_STATE=

ticks() { awk '{ print $14 + $15 }' "/proc/$1/stat"; }
# Opens the window, measures it, and closes it: name, then options of the program.
measure() {
    local name=$1
    shift
    local log=$folder/$name.log
    rm -f "$log"
    local begun
    begun=$(awk '{ print $1 }' /proc/uptime)
    "$program" --full-screen --frame-log "$log" "$@" &
    local pid=$!
    # The first frame after the first picture.
    until grep -q ' [1-9]' "$log" 2> /dev/null; do sleep 0.02; done
    local first
    first=$(awk -v begun="$begun" '$2 > 0 { printf "%.2f", $1 - begun; exit }' "$log")
    sleep 4
    local before frames_before after frames_after
    before=$(ticks $pid) frames_before=$(wc -l < "$log")
    sleep "$seconds"
    after=$(ticks $pid) frames_after=$(wc -l < "$log")
    awk -v name="$name" -v cpu=$(((after - before) * 10)) -v frames=$((frames_after - frames_before)) \
        -v s="$seconds" -v first="$first" -v rss="$(awk '/^VmRSS/ { print $2 / 1024 }' /proc/$pid/status)" 'BEGIN {
            printf "%-22s %6.1f frames/s  ", name, frames / s
            if (frames > 0) printf "%6.1f CPU ms/frame  ", cpu / frames; else printf "%24s", ""
            printf "%5.1f %% of a core  %4.0f MB  first sky after %s s\n", cpu / s / 10, rss, first
        }'
    kill $pid
    wait $pid 2> /dev/null || true
}

# Time stands; time goes on as it does; every line and name over it.
measure still --scene docs/window/moonlit.toml
measure "frame after frame" --scene docs/window/moonlit.toml --continuous
export NOCTURNE_STATE=$folder/state.toml
cp docs/window/everything.toml "$NOCTURNE_STATE"
measure "everything on" --continuous
