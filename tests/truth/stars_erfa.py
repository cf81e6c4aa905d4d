"""Makes `stars_erfa.csv`: apparent directions of stars by ERFA, beside the Earth that they were seen from.

    python3 stars_erfa.py de440.bsp ../../catalogs/hipparcos.csv > stars_erfa.csv

ERFA (pyerfa) alone: `pmsafe` from J1991.25 to J2000.0, `pmpx`, `ldsun`, `ab`. The Earth and the Sun
are those of JPL DE440, read with jplephem: the table holds them, so that the reduction is compared
and nothing else. Directions are in ICRS axes, from the centre of the Earth.
"""

import csv
import random
import sys

import erfa
import numpy as np
from jplephem.spk import SPK

AU_KM = 149597870.7
LIGHT_KM_S = 299792.458
DATES = 16

kernel = SPK.open(sys.argv[1])
random.seed(1991)


def state(centre, target, tdb):
    """Position in km, velocity in km/s."""
    position, velocity = kernel[centre, target].compute_and_differentiate(*tdb)
    return position, velocity / 86400


print("# ERFA %s by pyerfa %s, Earth and Sun by JPL DE440; made by stars_erfa.py." % (
    erfa.version.erfa_version, erfa.__version__))
print("# Barycentric km and km/s, ICRS axes; the direction is apparent, geocentric, ICRS axes.")
vectors = [f"{what}_{axis}" for what in ("earth_km", "earth_km_s", "sun_km", "dir") for axis in "xyz"]
print(",".join(["star", "jd_tdb_1", "jd_tdb_2", *vectors]))
for star in csv.DictReader(open(sys.argv[2])):
    number = {name: float(star[name]) for name in star if "_" in name}
    ra, dec = np.radians(number["ra_deg"]), np.radians(number["dec_deg"])
    motion = np.radians(number["pm_ra_mas_yr"] / 3.6e6) / np.cos(dec), np.radians(number["pm_dec_mas_yr"] / 3.6e6)
    at_j2000 = erfa.pmsafe(ra, dec, *motion, number["parallax_mas"] / 1000, number["radial_velocity_km_s"],
                           *erfa.epj2jd(1991.25), 2451545.0, 0.0)
    for index in range(DATES):
        # One in each part of 1600 to 2200.
        year = 1600 + 600 * (index + random.random()) / DATES
        tdb = 2451545.0 + round((year - 2000) * 365.25), round(random.random() - 0.5, 9)
        (a, va), (b, vb), (sun, _) = state(0, 3, tdb), state(3, 399, tdb), state(0, 10, tdb)
        earth, velocity = a + b, va + vb
        years = ((tdb[0] - 2451545.0) + tdb[1]) / 365.25
        direction = erfa.pmpx(*at_j2000, years, earth / AU_KM)
        from_sun = (earth - sun) / AU_KM
        distance = np.linalg.norm(from_sun)
        direction = erfa.ldsun(direction, from_sun / distance, distance)
        beta = velocity / LIGHT_KM_S
        direction = erfa.ab(direction, beta, distance, np.sqrt(1 - beta @ beta))
        cells = [f"{v:.4f}" for v in earth] + [f"{v:.10f}" for v in velocity]
        cells += [f"{v:.4f}" for v in sun] + [f"{v:.14f}" for v in direction]
        print(",".join([star["name"], f"{tdb[0]}", f"{tdb[1]}", *cells]))
