"""Refraction by two other programs, for `tests/refraction.rs`.

    pip install palpy==1.8.4 pyerfa==2.0.1.5
    python3 refraction.py > refraction.csv

`hohenkerk_sinclair_arcsec`: PAL `refro` (rays followed after Hohenkerk & Sinclair 1985, latitude 45
degrees, 6.5 K/km). `erfa_arcsec`: ERFA `refco`, A tan z + B tan^3 z, above 15 degrees, where it is
meant to be used.
"""

import math

import erfa
import palpy

ARCSEC = math.degrees(1) * 3600
AIRS = [  # metres, millibars, degrees Celsius, relative humidity, micrometres
    (0, 1013.25, 15, 0.0, 0.59),  # as the Pulkovo tables
    (0, 1010, 10, 0.0, 0.55),  # as Bennett's formula
    (0, 1013.25, 0, 0.5, 0.55),
    (0, 1010, 30, 0.8, 0.55),
    (0, 1030, -20, 0.2, 0.55),
    (100, 1000, 10, 0.5, 0.70),
    (2635, 743, 12, 0.1, 0.40),
    (4205, 615, 2, 0.3, 0.55),
]

print("# Made by refraction.py: PAL 0.9.10 through palpy 1.8.4, ERFA 2.0.1 through pyerfa 2.0.1.5.")
print(
    "height_m,pressure_mbar,temperature_c,humidity,wavelength_nm,apparent_deg,"
    "hohenkerk_sinclair_arcsec,erfa_arcsec"
)
for metres, mbar, celsius, humidity, micrometres in AIRS:
    a, b = erfa.refco(mbar, celsius, humidity, micrometres)
    for altitude in (0, 0.5, 1, 2, 5, 10, 15, 20, 30, 45, 60, 80):
        z = math.radians(90 - altitude)
        rays = palpy.refro(
            z, metres, celsius + 273.15, mbar, humidity, micrometres, math.radians(45), 0.0065, 1e-12
        )
        formula = a * math.tan(z) + b * math.tan(z) ** 3
        cell = f"{formula * ARCSEC:.4f}" if altitude >= 15 else ""
        print(
            f"{metres},{mbar},{celsius},{humidity},{micrometres * 1000:g},{altitude},"
            f"{rays * ARCSEC:.4f},{cell}"
        )
