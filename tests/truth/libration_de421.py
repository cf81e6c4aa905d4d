"""Librations of DE421 at random dates, for `libration_de421.csv`.

    pip install numpy
    python3 libration_de421.py jpl-librations.npy > libration_de421.csv

The array is that of the Python package `de421` 2008.1: Chebyshev coefficients of the Euler angles phi,
theta, psi, radians, in segments of eight days from JD 2414992.5 (TDB). Summed up by NumPy.
"""

import sys

import numpy as np

START, LENGTH = 2414992.5, 8
segments = np.load(sys.argv[1])
span = LENGTH * len(segments)
rng = np.random.default_rng(421)
days = np.sort(np.concatenate([[0, span], rng.uniform(0, span, 118)])).round(6)
print("# Made by libration_de421.py.")
print("day,fraction,phi_rad,theta_rad,psi_rad")
for day in days:
    segment = min(int(day // LENGTH), len(segments) - 1)
    x = 2 * (day - LENGTH * segment) / LENGTH - 1
    angles = np.polynomial.chebyshev.chebval(x, segments[segment].T)
    print(f"{START + int(day):.1f},{day % 1:.6f}," + ",".join(f"{angle:.12f}" for angle in angles))
