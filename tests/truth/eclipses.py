"""Makes the tables that `tests/eclipses.rs` compares with.

    python3 eclipses.py FOLDER_OF_SE1_FILES DE440.bsp

Writes `eclipse_list.csv`, `eclipse_contacts.csv`, `eclipse_deep.csv` (Swiss Ephemeris 2.10.03 with
the files of DE431) and `eclipse_local.csv` (the same, and DE440 with ERFA by Bessel's elements).
`eclipse_lunar.csv` and `eclipse_solar.csv` come from elsewhere; their first lines tell.
"""

import sys

import erfa
import numpy as np
import swisseph as swe
from jplephem.spk import SPK

swe.set_ephe_path(sys.argv[1])
KERNEL = SPK.open(sys.argv[2])
LIGHT_KM_S = 299792.458
EARTH_KM, FLATTENING = 6378.137, 1 / 298.257223563
SUN_KM, K_OUTER, K_INNER = 696000.0, 0.2725076, 0.272281


def tt(ut):
    return ut + swe.deltat_ex(ut, swe.FLG_SWIEPH)


def eclipses(body, start, end):
    """(kind letter, flags, contact times in UT) of every eclipse between two Julian dates."""
    find = swe.lun_eclipse_when if body == "moon" else swe.sol_eclipse_when_glob
    while True:
        flags, times = find(start, swe.FLG_SWIEPH, 0)
        if times[0] >= end:
            return
        if body == "moon":
            letters = ((swe.ECL_TOTAL, "T"), (swe.ECL_PARTIAL, "P"), (swe.ECL_PENUMBRAL, "N"))
        else:
            letters = ((swe.ECL_ANNULAR_TOTAL, "H"), (swe.ECL_TOTAL, "T"),
                       (swe.ECL_ANNULAR, "A"), (swe.ECL_PARTIAL, "P"))
        yield next(letter for flag, letter in letters if flags & flag), times
        start = times[0] + 10


def attributes(body, ut):
    """(magnitude, penumbral magnitude or ratio of diameters, Saros) at greatest eclipse."""
    if body == "moon":
        a = swe.lun_eclipse_how(ut, (0, 0, 0), swe.FLG_SWIEPH)[1]
        return a[0], a[1], int(a[9])
    a = swe.sol_eclipse_where(ut, swe.FLG_SWIEPH)[2]
    return a[0], a[1], int(a[9])


def year(y):
    return swe.julday(y, 1, 1, 0, swe.GREG_CAL if y > 1582 else swe.JUL_CAL)


def write(name, header, rows):
    with open(name, "w") as out:
        out.write(header)
        out.writelines(row + "\n" for row in rows)


def complete():
    for body in ("moon", "sun"):
        for kind, times in eclipses(body, year(1901), year(2101)):
            a = attributes(body, times[0])
            yield f"{body},{kind},{tt(times[0]):.6f},{a[2]},{a[0]:.4f},{a[1]:.4f}"


def contacts():
    for kind, t in eclipses("moon", year(2001), year(2031)):
        # P1 P4 U1 U4 U2 U3.
        cells = (f"{tt(t[i]):.6f}" if t[i] else "" for i in (6, 7, 2, 3, 4, 5))
        yield f"moon,{kind},{tt(t[0]):.6f}," + ",".join(cells)
    for kind, t in eclipses("sun", year(2001), year(2031)):
        greatest = tt(t[0])
        day, fraction = np.floor(greatest), greatest - np.floor(greatest)
        spans = (globe_contact(gap, day, fraction, side)
                 for gap in (outer_gap, inner_gap, axis_gap) for side in (-1, 1))
        cells = (f"{day + f:.7f}" if f else "" for f in spans)
        yield f"sun,{kind},{greatest:.6f}," + ",".join(cells)


def deep():
    """One eclipse of each body in each century whose kind no theory would doubt."""
    for body in ("moon", "sun"):
        for century in range(-3000, 3000, 100):
            for kind, t in eclipses(body, year(century), year(century + 100)):
                a = attributes(body, t[0])
                clear = (min(abs(a[0] - 1), abs(a[0])) > 0.2 or kind == "N" and a[1] > 0.3 > a[1] - 0.6
                         if body == "moon" else kind in "TA" and abs(a[1] - 1) > 0.02
                         or kind == "P" and 0.2 < a[0] < 0.8)
                if clear:
                    yield f"{body},{kind},{tt(t[0]):.6f},{a[2]},{a[0]:.4f},{a[1]:.4f}"
                    break


# DE440 and ERFA: apparent places, true equator and equinox of date.

def barycentric(body, day, fraction):
    if body == "sun":
        return KERNEL[0, 10].compute(day, fraction)
    target = 399 if body == "earth" else 301
    return KERNEL[0, 3].compute(day, fraction) + KERNEL[3, target].compute(day, fraction)


def apparent(body, day, fraction):
    earth = barycentric("earth", day, fraction)
    light_s = 0.0
    for _ in range(3):
        p = barycentric(body, day, fraction - light_s / 86400) - earth
        light_s = np.linalg.norm(p) / LIGHT_KM_S
    step = 1e-3
    velocity = (barycentric("earth", day, fraction + step) - barycentric("earth", day, fraction - step)) / (2 * step * 86400)
    beta = velocity / LIGHT_KM_S
    gamma = 1 / np.sqrt(1 - beta @ beta)
    u = p / np.linalg.norm(p)
    seen = u / gamma + beta + (u @ beta) * beta * gamma / (1 + gamma)
    return erfa.pnm06a(day, fraction) @ (seen / np.linalg.norm(seen) * np.linalg.norm(p))


class Bessel:
    """Elements of a solar eclipse in the fundamental plane, for one place; times in UT1 days."""

    def __init__(self, day, delta_t, longitude, latitude, height_m):
        self.day, self.delta_t, self.longitude = day, delta_t, np.radians(longitude)
        phi = np.radians(latitude)
        u = np.arctan((1 - FLATTENING) * np.tan(phi))
        height = height_m / 1000 / EARTH_KM
        self.rho_sin = (1 - FLATTENING) * np.sin(u) + height * np.sin(phi)
        self.rho_cos = np.cos(u) + height * np.cos(phi)
        self.latitude = phi

    def at(self, fraction, k):
        tt_fraction = fraction + self.delta_t
        sun, moon = (apparent(body, self.day, tt_fraction) / EARTH_KM for body in ("sun", "moon"))
        g = sun - moon
        distance = np.linalg.norm(g)
        a, d = np.arctan2(g[1], g[0]), np.arcsin(g[2] / distance)
        x = moon @ [-np.sin(a), np.cos(a), 0]
        y = moon @ [-np.cos(a) * np.sin(d), -np.sin(a) * np.sin(d), np.cos(d)]
        z = moon @ (g / distance)
        s = SUN_KM / EARTH_KM
        f1, f2 = np.arcsin((s + k) / distance), np.arcsin((s - k) / distance)
        l1, l2 = z * np.tan(f1) + k / np.cos(f1), z * np.tan(f2) - k / np.cos(f2)
        h = erfa.gst06a(self.day, fraction, self.day, tt_fraction) + self.longitude - a
        xi = self.rho_cos * np.sin(h)
        eta = self.rho_sin * np.cos(d) - self.rho_cos * np.cos(h) * np.sin(d)
        zeta = self.rho_sin * np.sin(d) + self.rho_cos * np.cos(h) * np.cos(d)
        return x - xi, y - eta, l1 - zeta * np.tan(f1), l2 - zeta * np.tan(f2)

    def outer(self, fraction):
        u, v, l1, _ = self.at(fraction, K_OUTER)
        return np.hypot(u, v) - l1

    def inner(self, fraction):
        u, v, _, l2 = self.at(fraction, K_INNER)
        return np.hypot(u, v) - abs(l2)

    def magnitude(self, fraction):
        u, v, l1, l2 = self.at(fraction, K_OUTER)
        return (l1 - np.hypot(u, v)) / (l1 + l2)

    def position_angle(self, fraction):
        u, v, _, _ = self.at(fraction, K_OUTER)
        return np.degrees(np.arctan2(u, v)) % 360


def bisect(f, low, high, steps=40):
    sign = f(low) > 0
    if sign == (f(high) > 0):
        return None
    for _ in range(steps):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if (f(middle) > 0) == sign else (low, middle)
    return 0.5 * (low + high)


# The globe, by brute force: what would a place near the rim of the Earth see?

def rim_points(day, fraction):
    """Sun, Moon, clearance of the axis, and points of the ellipsoid around the rim point nearest to it."""
    sun, moon = (apparent(body, day, fraction) for body in ("sun", "moon"))
    axis = (sun - moon) / np.linalg.norm(sun - moon)
    foot = moon - (moon @ axis) * axis
    squares = np.array([EARTH_KM, EARTH_KM, EARTH_KM * (1 - FLATTENING)]) ** 2
    side = np.cross(axis, foot / np.linalg.norm(foot))

    def point(normal):
        return squares * normal / np.sqrt(normal @ (squares * normal))

    # Around the rim in finer and finer steps, for the point where the axis is farthest out.
    angle, width = 0.0, 0.5
    out = foot / np.linalg.norm(foot)
    clearance = lambda a: (foot - point(np.cos(a) * out + np.sin(a) * side)) @ (np.cos(a) * out + np.sin(a) * side)
    for _ in range(30):
        angle = max((angle + width * i for i in (-1, -0.5, 0, 0.5, 1)), key=clearance)
        width *= 0.6
    normal = np.cos(angle) * out + np.sin(angle) * side
    tilts = np.radians(np.linspace(-1, 1, 41))
    return sun, moon, clearance(angle), [point(np.cos(t) * normal + np.sin(t) * axis) for t in tilts]


def discs(sun, moon, place, k):
    s, m = sun - place, moon - place
    separation = np.arctan2(np.linalg.norm(np.cross(s, m)), s @ m)
    return separation, np.arcsin(SUN_KM / np.linalg.norm(s)), np.arcsin(k * EARTH_KM / np.linalg.norm(m))


def outer_gap(day, fraction):
    sun, moon, clearance, places = rim_points(day, fraction)
    # Deep within, the rim is no place to look for the penumbra.
    if clearance < -500:
        return -1
    return min(d - s - m for d, s, m in (discs(sun, moon, p, K_OUTER) for p in places))


def inner_gap(day, fraction):
    sun, moon, clearance, places = rim_points(day, fraction)
    if clearance < -100:
        return -1
    sense = np.sign(clearance)
    return min(sense * d - abs(s - m) for d, s, m in (discs(sun, moon, p, K_INNER) for p in places))


def axis_gap(day, fraction):
    return rim_points(day, fraction)[2]


def globe_contact(gap, day, fraction, side):
    f = lambda t: gap(day, t)
    return bisect(f, fraction, fraction + side * 0.14, 26) if f(fraction) < 0 else None


PLACES = {
    "Wien 1999": (1999, 8, 11, 48.21, 16.37, 170), "Munich 1999": (1999, 8, 11, 48.137, 11.575, 520),
    "Lusaka 2001": (2001, 6, 21, -15.4, 28.3, 1280), "Madrid 2005": (2005, 10, 3, 40.4, -3.7, 660),
    "Side 2006": (2006, 3, 29, 36.767, 31.389, 10), "Hangzhou 2009": (2009, 7, 22, 30.27, 120.16, 10),
    "Male 2010": (2010, 1, 15, 4.175, 73.509, 1), "Tokyo 2012": (2012, 5, 20, 35.68, 139.69, 40),
    "Cairns 2012": (2012, 11, 13, -16.92, 145.77, 5), "Longyearbyen 2015": (2015, 3, 20, 78.22, 15.65, 10),
    "Madras 2017": (2017, 8, 21, 44.633, -121.129, 680), "Carbondale 2017": (2017, 8, 21, 37.727, -89.217, 120),
    "New York 2017": (2017, 8, 21, 40.71, -74.01, 10), "La Serena 2019": (2019, 7, 2, -29.9, -71.25, 30),
    "Union Glacier 2021": (2021, 12, 4, -79.77, -82.9, 700), "Exmouth 2023": (2023, 4, 20, -21.93, 114.13, 10),
    "San Antonio 2023": (2023, 10, 14, 29.42, -98.49, 200), "Mazatlan 2024": (2024, 4, 8, 23.22, -106.42, 5),
    "Dallas 2024": (2024, 4, 8, 32.78, -96.8, 130), "Cleveland 2024": (2024, 4, 8, 41.5, -81.69, 200),
    "Denver 2024": (2024, 4, 8, 39.74, -104.99, 1600), "Reykjavik 2026": (2026, 8, 12, 64.147, -21.94, 20),
    "Burgos 2026": (2026, 8, 12, 42.341, -3.702, 860), "Palma 2026": (2026, 8, 12, 39.57, 2.65, 10),
    "London 2026": (2026, 8, 12, 51.51, -0.13, 20), "Luxor 2027": (2027, 8, 2, 25.687, 32.64, 80),
}


def local():
    for name, (y, m, d, latitude, longitude, height) in PLACES.items():
        geopos = (longitude, latitude, height)
        start = swe.julday(y, m, d, 0) - 0.5
        t = next(e[1] for e in eclipses("sun", start, start + 3))[0]
        _, times, _ = swe.sol_eclipse_when_loc(t - 0.3, geopos, swe.FLG_SWIEPH)
        attr = swe.sol_eclipse_how(times[0], geopos, swe.FLG_SWIEPH)[1]
        day = np.floor(times[0])
        delta_t = swe.deltat_ex(times[0], swe.FLG_SWIEPH)
        bessel = Bessel(day, delta_t, longitude, latitude, height)
        middle = times[0] - day
        step = 1e-5
        slope = lambda f: bessel.magnitude(f + step) - bessel.magnitude(f - step)
        peak = bisect(slope, middle - 0.02, middle + 0.02)
        outer = [bisect(bessel.outer, *s) for s in ((peak - 0.1, peak), (peak, peak + 0.1))]
        inner = [bisect(bessel.inner, *s) for s in ((peak - 0.01, peak), (peak, peak + 0.01))]
        ours = [outer[0], inner[0], peak, inner[1], outer[1]]
        theirs = [times[1], times[2], times[0], times[3], times[4]]
        angles = [bessel.position_angle(f) if f else None for f in ours]
        if inner[0]:
            turn = 180 if bessel.at(peak, K_INNER)[3] < 0 else 0
            angles[1], angles[3] = ((a + turn) % 360 for a in (angles[1], angles[3]))
        cells = [f"{day + f:.7f}" if f else "" for f in ours]
        cells += [f"{f:.7f}" if f else "" for f in theirs]
        cells += [f"{angles[i]:.2f}" if angles[i] is not None else "" for i in (0, 1, 3, 4)]
        cells += [f"{bessel.magnitude(peak):.5f}", f"{attr[0]:.5f}", f"{attr[2]:.5f}"]
        cells += [f"{(attr[4] + 180) % 360:.4f}", f"{attr[5]:.4f}"]
        yield f"{name},{latitude},{longitude},{height},{delta_t * 86400:.3f}," + ",".join(cells)


SWISS = "# Swiss Ephemeris 2.10.03 with the .se1 files of DE431; made by eclipses.py.\n"

write("eclipse_list.csv", SWISS + "# All eclipses 1901-2100. Kinds: N penumbral, P partial, T total, A annular, H hybrid.\n"
      "# magnitude: umbral, or the part of the Sun's diameter covered; second: penumbral, or Moon over Sun.\n"
      "body,kind,jd_tt,saros,magnitude,second\n", complete())
write("eclipse_contacts.csv", "# All eclipses 2001-2030, Julian dates in TT; made by eclipses.py.\n"
      "# Moon: P1 P4 U1 U4 U2 U3, Swiss Ephemeris 2.10.03. Sun: greatest by the same; penumbra P1 P4, umbra\n"
      "# U1 U4, axis C1 C2 from DE440 and ERFA: when the first and the last place on WGS84 sees the discs touch.\n"
      "body,kind,greatest,outer_1,outer_2,umbra_1,umbra_2,inner_1,inner_2\n", contacts())
write("eclipse_deep.csv", SWISS + "# An eclipse of each body in each century, -3000 to 2999; columns as in eclipse_list.csv.\n"
      "body,kind,jd_tt,saros,magnitude,second\n", deep())
write("eclipse_local.csv",
      "# Solar eclipses at places, Julian dates in UT1; made by eclipses.py.\n"
      "# c1 to c4, max, pa_1 to pa_4 (degrees), magnitude: Bessel's elements from DE440 and ERFA, Sun\n"
      "# 696000 km, k 0.2725076 (c1, c4, max, magnitude) and 0.272281 (c2, c3), WGS84.\n"
      "# swe_*: sol_eclipse_when_loc, sol_eclipse_how of the Swiss Ephemeris 2.10.03 (one k, 0.27252).\n"
      "place,lat_deg,lon_deg,height_m,delta_t_s,c1,c2,max,c3,c4,swe_c1,swe_c2,swe_max,swe_c3,swe_c4,"
      "pa_1,pa_2,pa_3,pa_4,magnitude,swe_magnitude,swe_obscuration,swe_azimuth,swe_altitude\n", local())
