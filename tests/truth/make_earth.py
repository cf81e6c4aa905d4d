"""Makes earth_iau2006.csv and earth_long_term.csv from ERFA.

Needs pyerfa 2.0.1.5 and numpy. Run in this directory: python3 make_earth.py
"""

import erfa
import numpy as np

ARCSEC = np.pi / 180 / 3600
HEAD = "# Julian dates TT and UT1 (two parts each); nutation IAU 2000A_R06 (nut06a); "
NUMBERS = ",".join(["%.1f,%.6f"] * 2 + ["%.9f"] * 2 + ["%.15f"] * 6 + ["%.13f"])


def dates(low, high, count, seed):
    """Julian dates at noon and parts of a day, each somewhere in its share of the years."""
    years = low + (high - low) * (np.arange(count) + np.random.default_rng(seed).random(count)) / count
    days = (years - 2000) * 365.25
    return 2451545.0 + np.floor(days), np.round(days % 1.0, 6)


def table(name, head, columns, rows):
    with open(name, "w") as out:
        out.write(head + "# pyerfa 2.0.1.5. Made by make_earth.py.\n" + columns + "\n")
        for row in rows:
            out.write(NUMBERS % tuple(row[:13]) + "".join(",%.13f" % more for more in row[13:]) + "\n")


def standard():
    """60 dates of 1950-2050 and 120 of 1550-2650."""
    for low, high, count in ((1950, 2050, 60), (1550, 2650, 120)):
        for day, part in zip(*dates(low, high, count, 6)):
            ut1 = round((part + 0.237) % 1.0, 6)
            dpsi, deps = erfa.nut06a(day, part)
            matrix = erfa.pnm06a(day, part)
            sidereal = erfa.gst06a(day, ut1, day, part)
            mean = erfa.gmst06(day, ut1, day, part)
            yield (day, part, day, ut1, dpsi / ARCSEC, deps / ARCSEC, *matrix[0], *matrix[2], sidereal,
                   mean)


def travel(t):
    """Way of the mean equinox of ltp along its equator since J2000.0, radians, by definition."""

    def rate(century, step=0.05):
        axes = [erfa.ltp(2000.0 + 100.0 * (century + k * step)) for k in range(-3, 4)]
        weights = np.array([-1, 9, -45, 0, 45, -9, 1]) / 60 / step
        return sum(w * axis[0] for w, axis in zip(weights, axes)) @ axes[3][1]

    nodes, weights = np.polynomial.legendre.leggauss(40)
    return sum(w * rate(t / 2 * (1 + x)) for x, w in zip(nodes, weights)) * t / 2


def long_term():
    """50 dates of -4000 to 1340 and 20 of 2860 to 4000."""
    for low, high, count in ((-4000, 1340, 50), (2860, 4000, 20)):
        for day, part in zip(*dates(low, high, count, 11)):
            epoch = 2000 + (day - 2451545 + part) / 365.25
            dpsi, deps = erfa.nut06a(day, part)
            matrix = erfa.ltpb(epoch)
            t = (epoch - 2000) / 100
            mean = erfa.era00(day, part) + (0.014506 - 0.00380865 * t) * ARCSEC - travel(t)
            yield (day, part, day, part, dpsi / ARCSEC, deps / ARCSEC, *matrix[0], *matrix[2],
                   mean % (2 * np.pi))


table(
    "earth_iau2006.csv",
    HEAD + "true equinox\n# and pole in ICRS axes (pnm06a); Greenwich apparent sidereal time (gst06a), mean (gmst06).\n",
    "tt_1,tt_2,ut1_1,ut1_2,dpsi_arcsec,deps_arcsec,equinox_x,equinox_y,equinox_z,pole_x,pole_y,pole_z,"
    "sidereal_rad,mean_sidereal_rad",
    standard(),
)
table(
    "earth_long_term.csv",
    HEAD + "mean equinox\n# and pole in ICRS axes by Vondrak et al. 2011 (ltpb); Greenwich mean sidereal time: era00"
    ", the origin\n# of IAU 2006, and the way of that equinox along its equator, integrated over ltp.\n",
    "tt_1,tt_2,ut1_1,ut1_2,dpsi_arcsec,deps_arcsec,equinox_x,equinox_y,equinox_z,pole_x,pole_y,pole_z,"
    "sidereal_rad",
    long_term(),
)
