#!/bin/sh
# Sees to it that the machine can link a Rust program (`linker`), draw with Vulkan (`adapter`), open the window
# without a screen and a hand (`window`), or run Stellarium without a screen (`stellarium`): installs the Debian
# packages if this user may, and names them otherwise.
set -u

case "${1:-}" in
linker)
    command -v cc >/dev/null 2>&1 && exit 0
    packages="gcc libc6-dev"
    purpose="a C linker, which Rust needs"
    needed=1
    ;;
adapter)
    packages="mesa-vulkan-drivers libvulkan1"
    purpose="a Vulkan driver that draws in software, since no graphics adapter was found"
    needed=0
    ;;
window)
    if command -v Xvfb >/dev/null 2>&1 && command -v xdotool >/dev/null 2>&1 &&
        command -v xclip >/dev/null 2>&1; then
        exit 0
    fi
    packages="xvfb xdotool xclip libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0"
    purpose="a screen and a hand for the test of the real window"
    needed=0
    ;;
stellarium)
    if command -v stellarium >/dev/null 2>&1 && command -v Xvfb >/dev/null 2>&1 &&
        python3 -c "import ensurepip" 2>/dev/null; then
        exit 0
    fi
    packages="stellarium xvfb python3-venv"
    purpose="the planetarium to compare with, a screen for it, and Python to measure"
    needed=1
    ;;
*)
    echo "usage: $0 linker|adapter|window|stellarium" >&2
    exit 2
    ;;
esac

if [ "$(id -u)" = 0 ]; then
    as_root=""
elif sudo -n true 2>/dev/null; then
    as_root="sudo"
else
    as_root="none"
fi

if command -v apt-get >/dev/null 2>&1 && [ "$as_root" != none ]; then
    echo "Installing $packages: $purpose." >&2
    # shellcheck disable=SC2086  # the packages are words
    if $as_root apt-get update -qq >/dev/null &&
        $as_root env DEBIAN_FRONTEND=noninteractive \
            apt-get install -y -qq --no-install-recommends $packages >/dev/null; then
        exit 0
    fi
    echo "The installation failed. Install $packages by hand: $purpose." >&2
else
    echo "Please install $packages (on Debian: apt-get install $packages): $purpose." >&2
fi
# Without a linker nothing can be built. Without an adapter the program says so itself, and the
# tests that need one, or a window, are reported as ignored.
exit "$needed"
