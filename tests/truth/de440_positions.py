"""Makes de440_positions.csv: positions of DE440 over its span, for the table resampled from it.

    python3 tests/truth/de440_positions.py target/kernels/de440.bsp > tests/truth/de440_positions.csv

Needs numpy and jplephem 2.24.
"""

import sys

import numpy as np
from jplephem.spk import SPK

kernel = SPK.open(sys.argv[1])
TARGETS = {"mercury": 1, "venus": 2, "earth-moon": 3, "mars": 4, "jupiter": 5, "saturn": 6,
           "uranus": 7, "neptune": 8, "pluto": 9, "sun": 10}
rng = np.random.default_rng(440)
days = np.sort(rng.integers(2287185, 2688976, 36))
days[0], days[-1] = 2287184, 2688976
fractions = np.round(rng.uniform(-0.5, 0.5, len(days)), 9)
# The first and the last moment themselves, and a light-time in.
fractions[0], fractions[-1] = 0.5, 0.5

print("# JPL DE440 by jplephem 2.24 (de440_positions.py). ICRS axes, km. The Moon from the centre of")
print("# the Earth, all others from the barycentre of the solar system; jd_tdb_1 + jd_tdb_2 is TDB.")
print("body,jd_tdb_1,jd_tdb_2,x_km,y_km,z_km")
for day, fraction in zip(days.tolist(), fractions.tolist()):
    rows = {name: kernel[0, target].compute(day, fraction) for name, target in TARGETS.items()}
    rows["moon"] = kernel[3, 301].compute(day, fraction) - kernel[3, 399].compute(day, fraction)
    for name, position in rows.items():
        print(name, day, fraction, *(f"{value:.6f}" for value in position), sep=",")
