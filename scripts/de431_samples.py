"""Samples JPL DE431 for packing: positions at Chebyshev nodes, -3001 to +3001.

    pip install numpy pyswisseph
    python3 scripts/de431_samples.py FOLDER_OF_SE1_FILES target/kernels/de431_samples.bin

The files `*.se1` (Debian packages swe-basic-data and swe-standard-data, CC0-1.0) hold JPL DE431
(Folkner et al. 2014, IPN Progress Report 42-196). Positions are geometric, in axes of the ICRS:
Mercury to Mars and the barycentre of Earth and Moon from the centre of the Sun, the Sun and the
systems of Jupiter to Pluto from the barycentre of the solar system, the Moon from the centre of the
Earth. They are rounded to whole units, far coarser than the rounding of any machine.

Layout, little-endian: the mark "DE431SMP"; the number of channels (u32); for each channel its name (16
bytes, padded with zeros), the Julian date of the begin (f64), the days of a block (f64), the kilometres
of a unit (f64), the number of blocks (u32) and of nodes in a block (u32); then the positions of all
channels: block by block, node by node, x, y, z (i32). The node j of n stands at -cos(pi (j + 1/2) / n)
of its block, which reaches from -1 to +1.
"""

import struct
import sys

import numpy as np
import swisseph as swe

AU_KM = 149597870.7
# Of DE431; with it the barycentre of Earth and Moon follows from the Earth.
EARTH_MOON_MASS_RATIO = 81.30056907419062
START_JD = 2451545.0 - 5001 * 365.25
DAYS = 6002 * 365.25
FLAGS = (swe.FLG_SWIEPH | swe.FLG_XYZ | swe.FLG_EQUATORIAL | swe.FLG_J2000 | swe.FLG_ICRS
         | swe.FLG_NONUT | swe.FLG_TRUEPOS | swe.FLG_NOABERR | swe.FLG_NOGDEFL)


def place_km(jd, body, flags=0):
    place, used = swe.calc(jd, body, FLAGS | flags)
    if not used & swe.FLG_SWIEPH:
        sys.exit(f"body {body}: no file for JD {jd}; give the folder of all *.se1 files")
    return np.array(place[:3]) * AU_KM


def from_sun(body):
    return lambda jd: place_km(jd, body, swe.FLG_HELCTR)


def from_barycentre(body):
    return lambda jd: place_km(jd, body, swe.FLG_BARYCTR)


def earth_moon_barycentre(jd):
    return place_km(jd, swe.MOON) / (1 + EARTH_MOON_MASS_RATIO) - place_km(jd, swe.SUN)


# Name, function, days of a block, nodes, kilometres of a unit.
CHANNELS = [
    ("sun", from_barycentre(swe.SUN), 128, 12, 1.0),
    ("earth-moon", earth_moon_barycentre, 16, 14, 0.1),
    ("moon", lambda jd: place_km(jd, swe.MOON), 8, 16, 0.001),
    ("mercury", from_sun(swe.MERCURY), 8, 14, 0.1),
    ("venus", from_sun(swe.VENUS), 16, 12, 0.1),
    ("mars", from_sun(swe.MARS), 32, 14, 1.0),
    ("jupiter", from_barycentre(swe.JUPITER), 128, 10, 10.0),
    ("saturn", from_barycentre(swe.SATURN), 128, 10, 10.0),
    ("uranus", from_barycentre(swe.URANUS), 256, 10, 10.0),
    ("neptune", from_barycentre(swe.NEPTUNE), 256, 10, 10.0),
    ("pluto", from_barycentre(swe.PLUTO), 256, 10, 10.0),
]


def main(folder, output):
    swe.set_ephe_path(folder)
    blocks = [int(np.ceil(DAYS / days)) for _, _, days, _, _ in CHANNELS]
    with open(output, "wb") as file:
        file.write(b"DE431SMP" + struct.pack("<I", len(CHANNELS)))
        for (name, _, days, nodes, unit_km), count in zip(CHANNELS, blocks):
            file.write(struct.pack("<16s3d2I", name.encode(), START_JD, days, unit_km, count, nodes))
        for (name, function, days, nodes, unit_km), count in zip(CHANNELS, blocks):
            offsets = days / 2 * (1 - np.cos(np.pi * (np.arange(nodes) + 0.5) / nodes))
            for block in range(count):
                begin = START_JD + days * block
                places = np.array([function(begin + offset) for offset in offsets])
                file.write(np.rint(places / unit_km).astype("<i4").tobytes())
            print(f"{name}: {count} blocks of {days} days", file=sys.stderr)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
