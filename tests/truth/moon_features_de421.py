"""Makes moon_features_de421.csv: where named places on the Moon stand in the sky of a place, and where the
Sun stands over the Moon, by another program.

    pip install numpy pyerfa==2.0.1.5
    pip download --no-deps de421 && tar xzf de421-2008.1.tar.gz
    python3 moon_features_de421.py de421-2008.1/de421 > moon_features_de421.csv

Positions and integrated librations of JPL DE421, summed up by NumPy; principal axes to mean Earth and mean
rotation by Williams, Boggs & Folkner 2008 (67.92", 78.56", 0.30"). Precession, nutation and the turn of the
Earth by ERFA (IAU 2006/2000A); no polar motion. Light time; aberration by the observer's velocity. No air.
Each place stands on a sphere of 1737.4 km. Longitudes and latitudes of the places are those of the Gazetteer
of Planetary Nomenclature (IAU and USGS), written down here by hand. UT1 is TT less the seconds given.
"""

import sys

import erfa
import numpy as np

LIGHT_KM_S, DAY_S, RADIUS_KM = 299792.458, 86400.0, 1737.4
# All tables of DE421.
START_JD, SPAN_DAYS = 2414992.5, 13704 * 8
# Name, longitude east, latitude north, degrees.
PLACES = [
    ("Tycho", -11.22, -43.30),
    ("Copernicus", -20.08, 9.62),
    ("Plato", -9.38, 51.62),
    ("Mare Crisium", 59.10, 16.18),
    ("Aristarchus", -47.49, 23.73),
    ("Grimaldi", -68.36, -5.38),
    ("Langrenus", 61.04, -8.86),
    ("Clavius", -14.73, -58.62),
    ("Proclus", 46.89, 16.09),
    ("Kepler", -38.01, 8.12),
]
# TT as two parts of a Julian date, TT - UT1 in seconds, longitude east, latitude, height of the observer.
INSTANTS = [
    ((2435200.5, 0.40), 31.1, -111.65127, 35.19807, 2106.0),
    ((2442700.5, 0.15), 45.9, 18.4232, -33.9258, 25.0),
    ((2451624.5, 0.85), 63.9, 139.6917, 35.6895, 40.0),
    ((2461278.5, 0.25), 69.2, -111.65127, 35.19807, 2106.0),
    ((2469400.5, 0.60), 85.0, -70.4042, -24.6272, 2635.0),
]

folder = sys.argv[1]
tables = {name: np.load(f"{folder}/jpl-{name}.npy") for name in ("earthmoon", "moon", "sun", "librations")}
constants = dict(np.load(f"{folder}/constants.npy"))
MOON_SHARE = 1 / (1 + constants[b"EMRAT"])


def series(name, day, fraction, rate=False):
    table = tables[name]
    length = SPAN_DAYS / len(table)
    since = (day - START_JD) + fraction
    at = int(since // length)
    x = 2 * (since - at * length) / length - 1
    value = np.polynomial.chebyshev.chebval(x, table[at].T)
    if not rate:
        return value
    slope = np.polynomial.chebyshev.chebval(x, np.polynomial.chebyshev.chebder(table[at].T))
    return value, slope * 2 / length / DAY_S


def earth(day, fraction, rate=False):
    if not rate:
        return series("earthmoon", day, fraction) - MOON_SHARE * series("moon", day, fraction)
    (b, bv), (m, mv) = series("earthmoon", day, fraction, True), series("moon", day, fraction, True)
    return b - MOON_SHARE * m, bv - MOON_SHARE * mv


def moon(day, fraction):
    return earth(day, fraction) + series("moon", day, fraction)


def moon_fixed(day, fraction):
    phi, theta, psi = series("librations", day, fraction)
    second = np.radians(1 / 3600)
    matrix = erfa.rz(psi, erfa.rx(theta, erfa.rz(phi, np.eye(3))))
    return erfa.rx(-0.30 * second, erfa.ry(-78.56 * second, erfa.rz(-67.92 * second, matrix)))


def spherical(v):
    return np.degrees(np.arctan2(v[1], v[0])), np.degrees(np.arcsin(v[2] / np.linalg.norm(v)))


print("# Made by moon_features_de421.py, which says how.")
print(
    "jd_tt_1,jd_tt_2,jd_ut1_2,lon_deg_E,lat_deg_N,height_m,libration_lon_deg,libration_lat_deg,"
    "subsolar_lon_deg,subsolar_lat_deg,name,place_lon_deg,place_lat_deg,azimuth_deg,altitude_deg"
)
for (day, tt), delta_t, lon, lat, height in INSTANTS:
    ut1 = tt - delta_t / DAY_S
    tdb = tt + erfa.dtdb(day, tt, 0, 0, 0, 0) / DAY_S
    matrix = erfa.pnm06a(day, tt)
    sidereal = erfa.gst06(day, ut1, day, tt, matrix)
    turn = erfa.rz(sidereal, matrix)
    site = erfa.gd2gc(1, np.radians(lon), np.radians(lat), height) / 1000
    centre, velocity = earth(day, tdb, True)
    observer = centre + turn.T @ site
    spin = np.array([-site[1], site[0], 0.0]) * 7.292115855e-5
    velocity = velocity + turn.T @ spin
    seconds = 0.0
    for _ in range(6):
        seconds = np.linalg.norm(moon(day, tdb - seconds / DAY_S) - observer) / LIGHT_KM_S
    then = tdb - seconds / DAY_S
    axes, middle = moon_fixed(day, then), moon(day, then)
    sunlight = 0.0
    for _ in range(6):
        sun = series("sun", day, then - sunlight / DAY_S)
        sunlight = np.linalg.norm(sun - middle) / LIGHT_KM_S
    libration, subsolar = spherical(axes @ (observer - middle)), spherical(axes @ (sun - middle))
    up, north = erfa.s2c(np.radians(lon), np.radians(lat)), np.array([0.0, 0.0, 1.0])
    north = north - up * up[2]
    north /= np.linalg.norm(north)
    east = np.cross(north, up)
    for name, place_lon, place_lat in PLACES:
        normal = erfa.s2c(np.radians(place_lon), np.radians(place_lat))
        place = middle + axes.T @ normal * RADIUS_KM - observer
        seen = place / np.linalg.norm(place)
        beta = velocity / LIGHT_KM_S
        sun_au = np.linalg.norm(sun - observer) / 149597870.7
        seen = erfa.ab(seen, beta, sun_au, np.sqrt(1 - beta @ beta))
        x, y, z = (turn @ seen) @ north, (turn @ seen) @ east, (turn @ seen) @ up
        azimuth, altitude = np.degrees(np.arctan2(y, x)) % 360, np.degrees(np.arcsin(z))
        print(
            f"{day},{tt:.9f},{ut1:.9f},{lon},{lat},{height},"
            f"{libration[0]:.6f},{libration[1]:.6f},{subsolar[0]:.6f},{subsolar[1]:.6f},"
            f"{name},{place_lon},{place_lat},{azimuth:.6f},{altitude:.6f}"
        )
