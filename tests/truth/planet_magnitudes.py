"""Writes planet_magnitudes.csv: magnitudes of planets by Skyfield's magnitudelib over their ranges.

Skyfield follows the authors' Fortran of Mallama & Hilton 2018, without the rotation of Mars.
"""

import numpy as np
import skyfield
from skyfield import magnitudelib as lib

# name, range of phases, function of (r, delta, phase, sun latitude, observer latitude, year)
PLANETS = [
    ("Mercury", (2.1, 169.0), lambda r, d, a, s, o, y: lib._mercury_magnitude(r, d, a)),
    ("Venus", (2.1, 178.0), lambda r, d, a, s, o, y: lib._venus_magnitude(r, d, a)),
    ("Mars", (0.0, 120.0), lambda r, d, a, s, o, y: lib._mars_magnitude(r, d, a)),
    ("Jupiter", (0.0, 130.0), lambda r, d, a, s, o, y: lib._jupiter_magnitude(r, d, a)),
    ("Saturn", (0.0, 6.4), lambda r, d, a, s, o, y: lib._saturn_magnitude(r, d, a, s, o)),
    ("Uranus", (0.0, 154.0), lambda r, d, a, s, o, y: lib._uranus_magnitude(r, d, a, s, o)),
    ("Neptune", (0.0, 133.0), lambda r, d, a, s, o, y: lib._neptune_magnitude(r, d, a, y)),
]
VIEWS = 12

random = np.random.default_rng(20180822)
print("# Apparent V magnitudes of planets by skyfield", skyfield.__version__, "(planet_magnitudes.py),")
print("# after the program of Mallama & Hilton 2018. Columns as in light_planet_magnitudes.csv.")
print(
    "planet,sun_distance_au,observer_distance_au,phase_deg,sun_latitude_deg,"
    "observer_latitude_deg,year,v_mag,tolerance_mag"
)
for name, (low, high), magnitude in PLANETS:
    for view in range(VIEWS):
        phase = round(low + (high - low) * view / (VIEWS - 1), 3)
        r, d = (round(float(x), 6) for x in random.uniform(0.3, 31.0, 2))
        limit = 26.5 if name == "Saturn" else 80.0
        sun, observer = (round(float(x), 4) for x in random.uniform(-limit, limit, 2))
        year = round(float(random.uniform(2000.1, 2050.0)), 2)
        v = float(magnitude(r, d, np.float64(phase), np.float64(sun), np.float64(observer), year))
        latitudes = (sun, observer) if name in ("Saturn", "Uranus") else (0, 0)
        print(f"{name},{r},{d},{phase},{latitudes[0]},{latitudes[1]},{year},{v:.5f},0.00001")
