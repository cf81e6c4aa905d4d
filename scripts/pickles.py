"""Packs the spectra of Pickles 1998 onto the grid of `src/light/spectrum.rs`.

    python3 scripts/pickles.py pickles_uvk_10A.csv catalogs/spectra/pickles.csv

The table it reads has a line for each type, at steps of 1 nm, 1 at 555.6 nm. Means are taken under a
triangle of 5 nm half width around each node of the grid, cut where the grid ends.
"""

import csv
import sys

GRID_NM = [360 + 5 * k for k in range(95)]

with open(sys.argv[1], newline="") as table:
    head, *rows = csv.reader(table)
at_nm = [int(angstrom) / 10 for angstrom in head[1:]]
with open(sys.argv[2], "w") as packed:
    packed.write("type," + ",".join(str(nm) for nm in GRID_NM) + "\n")
    for name, *cells in rows:
        values = [float(cell) for cell in cells]
        nodes = []
        for centre in GRID_NM:
            weights = [
                max(0.0, 1 - abs(nm - centre) / 5) if 360 <= nm <= 830 else 0.0 for nm in at_nm
            ]
            mean = sum(w * v for w, v in zip(weights, values)) / sum(weights)
            nodes.append(f"{mean:.5g}")
        packed.write(name + "," + ",".join(nodes) + "\n")
