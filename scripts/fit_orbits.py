"""Prints the mean orbits of src/ephemeris/de440/orbits.rs: Kepler ellipses fitted to DE440.

    python3 scripts/fit_orbits.py target/kernels/de440.bsp

They are references: what is stored is how far DE440 strays from them. Other orbits would change the
size of the file, not the positions. Needs numpy and jplephem.
"""

import sys

import numpy as np
from jplephem.spk import SPK

FIRST, LAST = 2287184.5, 2688976.5
AU_KM = 149597870.7
TILT = np.deg2rad(84381.406 / 3600)
FIELDS = ["axis_km", "longitude_rad", "eccentricity_cos", "eccentricity_sin",
          "perihelion_turn_rad", "inclination_cos", "inclination_sin", "node_turn_rad"]
# Where to begin: au, then degrees (mean longitude, its rate per century), eccentricity, degrees
# (perihelion, inclination, node). Rounded from Simon et al. 1994 and Standish.
PLANETS = {
    "MERCURY": (1, 10, 0.3871, 252.2509, 149472.6746, 0.2056, 77.456, 7.005, 48.331),
    "VENUS": (2, 10, 0.7233, 181.9798, 58517.8157, 0.0068, 131.564, 3.395, 76.680),
    "EARTH_MOON": (3, 10, 1.0000, 100.4665, 35999.3729, 0.0167, 102.937, 0.0, 174.873),
    "MARS": (4, 10, 1.5237, 355.4330, 19140.3027, 0.0934, 336.060, 1.850, 49.558),
    "JUPITER": (5, 0, 5.2026, 34.3515, 3034.9057, 0.0485, 14.331, 1.303, 100.464),
    "SATURN": (6, 0, 9.5549, 50.0774, 1222.1138, 0.0555, 93.057, 2.489, 113.666),
    "URANUS": (7, 0, 19.2184, 314.0550, 428.4669, 0.0464, 173.005, 0.773, 74.006),
    "NEPTUNE": (8, 0, 30.1104, 304.3487, 218.4862, 0.0095, 48.120, 1.770, 131.784),
    "PLUTO": (9, 0, 39.4869, 238.9654, 145.1804, 0.2489, 224.097, 17.141, 110.302),
}


def powers(coefficients, t):
    return sum(c * t**n for n, c in enumerate(coefficients))


def positions(elements, jd):
    """As Orbit::at in src/ephemeris/resampled/reference.rs."""
    t = (jd - 2451545.0) / 36525.0
    a, longitude, k0, h0, w, q0, p0, node = (powers(elements[f], t) for f in FIELDS)
    k, h = k0 * np.cos(w) - h0 * np.sin(w), k0 * np.sin(w) + h0 * np.cos(w)
    q, p = q0 * np.cos(node) - p0 * np.sin(node), q0 * np.sin(node) + p0 * np.cos(node)
    f = longitude
    for _ in range(6):
        f = f - (f - k * np.sin(f) + h * np.cos(f) - longitude) / (1 - k * np.cos(f) - h * np.sin(f))
    sin, cos = np.sin(f), np.cos(f)
    beta = 1 / (1 + np.sqrt(1 - h * h - k * k))
    x = a * ((1 - beta * h * h) * cos + beta * h * k * sin - k)
    y = a * ((1 - beta * k * k) * sin + beta * h * k * cos - h)
    root = np.sqrt(1 - p * p - q * q)
    ecliptic = np.stack([(1 - 2 * p * p) * x + 2 * p * q * y,
                         2 * p * q * x + (1 - 2 * q * q) * y,
                         2 * root * (q * y - p * x)])
    turn = np.array([[1, 0, 0], [0, np.cos(TILT), -np.sin(TILT)], [0, np.sin(TILT), np.cos(TILT)]])
    return (turn @ ecliptic).T


def fitted(elements, free, truth, jd):
    """Gauss-Newton with differences; steps shrink with the power of time that they stand at."""
    keys = [(field, n) for field in free for n in range(len(elements[field]))]
    for _ in range(6):
        residual = (truth - positions(elements, jd)).ravel()
        columns = []
        for field, n in keys:
            kept = elements[field][n]
            step = (1e-6 * elements[field][0] if field == "axis_km" else 1e-7) / 6.0**n
            elements[field][n] = kept + step
            above = positions(elements, jd)
            elements[field][n] = kept - step
            columns.append(((above - positions(elements, jd)) / (2 * step)).ravel())
            elements[field][n] = kept
        matrix = np.stack(columns, axis=1)
        size = np.linalg.norm(matrix, axis=0)
        solution = np.linalg.lstsq(matrix / size, residual, rcond=1e-13)[0] / size
        for (field, n), change in zip(keys, solution):
            elements[field][n] += change
    return np.linalg.norm(truth - positions(elements, jd), axis=1).max()


def show(name, elements, strays):
    print(f"/// Strays by {strays:.2g} km.\npub const {name}: Orbit = Orbit {{")
    for field in FIELDS:
        values = [float(value) for value in elements[field]] + [0.0] * (4 - len(elements[field]))
        print(f"    {field}: [{', '.join(f'{v:.11e}' if v else '0.0' for v in values)}],")
    print("};\n")


def main():
    kernel = SPK.open(sys.argv[1])
    rng = np.random.default_rng(1)

    def position(target, center, jd):
        return kernel[center, target].compute(jd).T

    for name, (target, center, a, longitude, rate, e, perihelion, i, node) in PLANETS.items():
        jd = np.sort(rng.uniform(FIRST, LAST, 6000))
        truth = position(target, 0, jd) - (position(center, 0, jd) if center else 0)
        rad = np.deg2rad
        half = np.sin(rad(i) / 2)
        elements = {
            "axis_km": [a * AU_KM, 0, 0, 0],
            "longitude_rad": [rad(longitude), rad(rate), 0, 0],
            "eccentricity_cos": [e * np.cos(rad(perihelion)), 0, 0, 0],
            "eccentricity_sin": [e * np.sin(rad(perihelion)), 0, 0, 0],
            "perihelion_turn_rad": [0],
            "inclination_cos": [half * np.cos(rad(node)), 0, 0, 0],
            "inclination_sin": [half * np.sin(rad(node)), 0, 0, 0],
            "node_turn_rad": [0],
        }
        elements = {field: list(map(float, values)) for field, values in elements.items()}
        free = [f for f in FIELDS if not f.endswith("turn_rad")]
        show(name, elements, fitted(elements, free, truth, jd))

    # The ellipse of the Moon hardly changes in axes that turn with its perigee and its node.
    jd = np.sort(rng.uniform(FIRST, LAST, 20000))
    truth = position(301, 3, jd) - position(399, 3, jd)
    rad = np.deg2rad
    elements = {
        "axis_km": [383398.0, 0.0],
        "longitude_rad": [rad(218.3167), rad(481266.484), 0.0],
        "eccentricity_cos": [0.0549, 0.0],
        "eccentricity_sin": [0.0],
        "perihelion_turn_rad": [rad(83.3532), rad(4067.617), 0.0],
        "inclination_cos": [0.0449, 0.0],
        "inclination_sin": [0.0],
        "node_turn_rad": [rad(125.0446), rad(-1935.533), 0.0],
    }
    free = [f for f in FIELDS if not f.endswith("sin")]
    show("MOON", elements, fitted(elements, free, truth, jd))


if __name__ == "__main__":
    main()
