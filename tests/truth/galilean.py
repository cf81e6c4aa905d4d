"""Writes galilean.csv: the moons of Jupiter by JPL's JUP310, from the excerpts that Skyfield tests with.

Needs skyfield and jplephem. Positions from the centre of Jupiter, kilometres, ICRS axes.
"""

import pathlib

import numpy as np
import skyfield
from jplephem.spk import SPK

MOONS = {501: "Io", 502: "Europa", 503: "Ganymede", 504: "Callisto"}
JUPITER = 599
DATA = pathlib.Path(skyfield.__file__).parent / "tests" / "data"

print("# The Galilean moons from the centre of Jupiter by JPL's JUP310 (Jacobson), ICRS axes.")
print(f"# Source: excerpts of jup310.bsp in the tests of skyfield {skyfield.__version__}; galilean.py. Facts.")
print("moon,jd_tdb,x_km,y_km,z_km")
for name in ["jup310-2015-03-02.bsp", "jup310-2053-10-08.bsp"]:
    segments = {segment.target: segment for segment in SPK.open(DATA / name).segments}
    parts = [segments[target] for target in [*MOONS, JUPITER]]
    first = max(part.start_jd for part in parts)
    last = min(part.end_jd for part in parts)
    for jd in np.linspace(first, last, 7):
        jupiter = segments[JUPITER].compute(jd)[:3]
        for target, moon in MOONS.items():
            x, y, z = segments[target].compute(jd)[:3] - jupiter
            print(f"{moon},{jd:.6f},{x:.1f},{y:.1f},{z:.1f}")
