"""Makes de440_excerpt.bsp, a month of DE440, and de440_excerpt.csv, positions that jplephem reads
from it.

    python3 tests/truth/de440_excerpt.py target/kernels/de440.bsp

Needs jplephem 2.22.
"""

import pathlib
import subprocess
import sys

from jplephem.spk import SPK

here = pathlib.Path(__file__).parent
excerpt = here / "de440_excerpt.bsp"
excerpt.unlink(missing_ok=True)
subprocess.run(
    [sys.executable, "-m", "jplephem", "excerpt", "--targets", "1,2,3,4,5,6,7,8,9,10,301,399",
     "2000/1/1", "2000/1/16", sys.argv[1], str(excerpt)],
    check=True,
)
kernel = SPK.open(str(excerpt))
with open(here / "de440_excerpt.csv", "w", encoding="ascii") as table:
    table.write("# Positions in de440_excerpt.bsp (JPL DE440), km, by jplephem; NAIF numbers.\n")
    table.write("target,center,jd_tdb_1,jd_tdb_2,x_km,y_km,z_km\n")
    for segment in kernel.segments:
        for day, fraction in [(2451545, 0.0), (2451547, 0.123456789), (2451552, -0.5), (2451558, 0.25)]:
            x, y, z = segment.compute(day, fraction)
            table.write(f"{segment.target},{segment.center},{day},{fraction},{x!r},{y!r},{z!r}\n"
                        .replace("np.float64(", "").replace(")", ""))
