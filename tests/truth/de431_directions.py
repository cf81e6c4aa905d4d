"""Makes `de431_directions.csv`: geometric places seen from the Earth over six millennia.

    pip install pyswisseph
    python3 tests/truth/de431_directions.py FOLDER_OF_SE1_FILES > tests/truth/de431_directions.csv

The files `*.se1` (Debian packages swe-basic-data and swe-standard-data, CC0-1.0) hold JPL DE431. Each
body has dates of its own, drawn at random, forty in each millennium.
"""

import random
import sys

import swisseph as swe

BODIES = ["sun", "moon", "mercury", "venus", "mars", "jupiter", "saturn", "uranus", "neptune", "pluto"]
FLAGS = (swe.FLG_SWIEPH | swe.FLG_EQUATORIAL | swe.FLG_J2000 | swe.FLG_ICRS | swe.FLG_NONUT
         | swe.FLG_TRUEPOS | swe.FLG_NOABERR | swe.FLG_NOGDEFL)
FIRST_JD = 2451545.0 - 5000 * 365.25

swe.set_ephe_path(sys.argv[1])
dates = random.Random("de431")
print("# Geometric places from the centre of the Earth in axes of the ICRS, by de431_directions.py")
print(f"# JPL DE431 in the files of Swiss Ephemeris {swe.version}, pyswisseph {swe.__version__}")
print("# Planets from Jupiter on are the barycentres of their systems.")
print("body,jd_tdb,ra_deg,dec_deg,dist_au")
for index, name in enumerate(BODIES):
    for millennium in range(6):
        for _ in range(40):
            jd = round(FIRST_JD + 365250 * (millennium + dates.random()), 4)
            place, used = swe.calc(jd, index, FLAGS)
            if not used & swe.FLG_SWIEPH:
                sys.exit(f"{name}: no file for JD {jd} in {sys.argv[1]}")
            print(f"{name},{jd:.4f},{place[0]:.8f},{place[1]:.8f},{place[2]:.11f}")
