"""Selects the rows of `ephemeris_de440.csv` from the full table of apparent places.

    python3 select_de440.py apparent_places_de440.csv > ephemeris_de440.csv

The full table (2000 rows) was computed with JPL DE440 and ERFA; its comment lines say how and are
kept as they are. The selection is every k-th row of each body in the order of time, so that it
spreads over 1550-2650; more rows for the Moon, whose libration is known for 1900-2050 alone.
"""

import sys

ROWS = {"moon": 80, "barnard": 0}
ROWS_OF_OTHERS = 22

comments, header, rows = [], None, {}
for line in open(sys.argv[1]):
    if line.startswith("#"):
        comments.append(line)
    elif header is None:
        header = line
    else:
        rows.setdefault(line.split(",")[0], []).append(line)

sys.stdout.writelines(comments)
print("# Selected from it by select_de440.py: a spread over time of each body but Barnard's star.")
sys.stdout.write(header)
for body, lines in rows.items():
    wanted = ROWS.get(body, ROWS_OF_OTHERS)
    if wanted == 0:
        continue
    lines.sort(key=lambda line: sum(map(float, line.split(",")[1:3])))
    last = len(lines) - 1
    picks = sorted({round(i * last / (wanted - 1)) for i in range(wanted)})
    sys.stdout.writelines(lines[i] for i in picks)
