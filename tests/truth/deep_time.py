"""Makes `ephemeris_deep_time.csv`: apparent geocentric places over eight millennia.

    pip install pyswisseph
    python3 deep_time.py FOLDER_OF_SE1_FILES > ephemeris_deep_time.csv

The files `*.se1` (Debian packages swe-basic-data and swe-standard-data, CC0-1.0) hold JPL DE431.
Swiss Ephemeris reduces with light time, deflection by the Sun, aberration, the precession of
Vondrak et al. 2011 and the nutation IAU 2000B.
"""

import sys

import swisseph as swe

BODIES = ["sun", "moon", "mercury", "venus", "mars", "jupiter", "saturn", "uranus", "neptune", "pluto"]
YEARS = [-4000, -3749, -3501, -3250, -2999, -2744, -2500, -2251, -1998, -1750, -1499, -1253, -999,
         -748, -501, -250, 1, 249, 503, 748, 1001, 1249, 1500, 1752, 1999, 2251, 2500, 2753, 2998,
         3251, 3500, 3749, 3999]

swe.set_ephe_path(sys.argv[1])
flags = swe.FLG_SWIEPH | swe.FLG_EQUATORIAL
print("# Apparent geocentric places, true equator and equinox of date, by deep_time.py")
print(f"# JPL DE431 in the files of Swiss Ephemeris {swe.version}, pyswisseph {swe.__version__}")
print("# Planets from Jupiter on are the barycentres of their systems. Distances are light-time-retarded.")
print("body,jd_tt,ra_deg,dec_deg,dist_au")
for index, name in enumerate(BODIES):
    for i, year in enumerate(YEARS):
        jd = round(2451545.0 + 365.25 * (year - 2000) + 17.381 * (i + 3 * index) % 365.25, 3)
        place, used = swe.calc(jd, index, flags)
        if not used & swe.FLG_SWIEPH:
            sys.exit(f"{name}: no file for the year {year} in {sys.argv[1]}")
        print(f"{name},{jd:.3f},{place[0]:.8f},{place[1]:.8f},{place[2]:.10f}")
