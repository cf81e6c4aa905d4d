#!/usr/bin/env python3
"""Makes catalogs/spectra/integrated_starlight.csv: the bluest and the reddest mix of starlight.

    scripts/starlight_spectra.py pickles_uvk_10A.csv > catalogs/spectra/integrated_starlight.csv

Two mixes of templates of Pickles 1998, a young and an old population with shares of the light in V,
are blended until their B-V are 0.50 and 1.20. Passbands of Bessell 1990 (recalled), zero of B-V at
the template of A0V. Needs numpy.
"""
import csv
import sys

import numpy as np

YOUNG = {"B1V": 0.08, "B5III": 0.10, "A0V": 0.18, "A5V": 0.14, "F5V": 0.22, "G2V": 0.14, "K1III": 0.14}
OLD = {"G2V": 0.04, "K0III": 0.16, "K3III": 0.28, "K5III": 0.27, "M2III": 0.25}
ENDS_B_V = (0.50, 1.20)

# From 360 nm by 10 nm, and from 470 nm by 10 nm.
B = [0, .03, .134, .567, .92, .978, 1, .978, .935, .853, .74, .64, .536, .424, .325, .235, .15, .095, .043, .009, 0]
V = [0, .03, .163, .458, .78, .967, 1, .973, .898, .792, .684, .574, .461, .359, .27, .197, .135, .081, .045, .025, .017, .013, .009, 0]

rows = list(csv.reader(open(sys.argv[1])))
nm = np.array(rows[0][1:], float) / 10
template = {row[0]: np.array(row[1:], float) for row in rows[1:]}


def photons(spectrum, first_nm, band):
    response = np.interp(nm, first_nm + 10.0 * np.arange(len(band)), band, 0, 0)
    return (spectrum * nm * response).sum()


def b_v(spectrum):
    ratio = lambda s: photons(s, 360, B) / photons(s, 470, V)
    return -2.5 * np.log10(ratio(spectrum) / ratio(template["A0V"]))


def mix(shares):
    light = sum(share * template[name] / photons(template[name], 470, V) for name, share in shares.items())
    return light / photons(light, 470, V)


young, old = mix(YOUNG), mix(OLD)
assert b_v(young) < ENDS_B_V[0] < ENDS_B_V[1] < b_v(old), (b_v(young), b_v(old))


def blend(wanted):
    low, high = 0.0, 1.0
    for _ in range(60):
        share = 0.5 * (low + high)
        if b_v(young * (1 - share) + old * share) < wanted:
            low = share
        else:
            high = share
    return young * (1 - share) + old * share


blue, red = (blend(wanted) for wanted in ENDS_B_V)
at_555 = lambda s: np.interp(555.0, nm, s)
print("wavelength_nm,blue,red")
for at in np.arange(350, 841):
    values = (np.interp(at, nm, end) / at_555(end) for end in (blue, red))
    print(",".join([str(at)] + ["%.4f" % value for value in values]))
for share in np.linspace(0, 1, 11):
    print("# share %.1f: B-V %.3f" % (share, b_v(blue * (1 - share) + red * share)), file=sys.stderr)
