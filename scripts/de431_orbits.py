"""Prints the mean orbits of src/ephemeris/de431/orbits.rs: Kepler ellipses fitted to DE431.

    pip install numpy jplephem
    python3 scripts/de431_orbits.py target/kernels/de431_samples.bin

As `fit_orbits.py`, for the samples that `de431_samples.py` writes.
"""

import sys

import numpy as np
from de431_moon import Samples
from fit_orbits import AU_KM, FIELDS, PLANETS, fitted, show

FIRST, LAST = 2451545.0 - 5001 * 365.25 + 1, 2451545.0 + 1001 * 365.25 - 1


def main():
    samples = Samples(sys.argv[1])
    random = np.random.default_rng(1)
    for name, (_, _, a, longitude, rate, e, perihelion, i, node) in PLANETS.items():
        jd = np.sort(random.uniform(FIRST, LAST, 12_000))
        truth = samples.km(name.lower().replace("_", "-"), jd)
        perihelion, node, half = np.radians(perihelion), np.radians(node), np.sin(np.radians(i / 2))
        elements = {
            "axis_km": [a * AU_KM, 0, 0, 0],
            "longitude_rad": [np.radians(longitude), np.radians(rate), 0, 0],
            "eccentricity_cos": [e * np.cos(perihelion), 0, 0, 0],
            "eccentricity_sin": [e * np.sin(perihelion), 0, 0, 0],
            "perihelion_turn_rad": [0],
            "inclination_cos": [half * np.cos(node), 0, 0, 0],
            "inclination_sin": [half * np.sin(node), 0, 0, 0],
            "node_turn_rad": [0],
        }
        elements = {field: list(map(float, values)) for field, values in elements.items()}
        free = [field for field in FIELDS if not field.endswith("turn_rad")]
        show(name, elements, fitted(elements, free, truth, jd))


if __name__ == "__main__":
    main()
