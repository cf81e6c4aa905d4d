"""Makes tdb_minus_tt.csv and delta_t_curve.csv from other people's libraries.

Needs pyerfa 2.0.1.5 and skyfield 1.55. Run in this directory: python3 make_time.py
"""

import erfa
from skyfield.api import load

with open("tdb_minus_tt.csv", "w") as out:
    out.write("# TDB - TT at the geocentre, seconds: erfa.dtdb(jd_tt, 0, 0, 0, 0, 0), pyerfa 2.0.1.5,\n")
    out.write("# the full series of Fairhead & Bretagnon. Made by make_time.py.\n")
    out.write("jd_tt,tdb_minus_tt_s\n")
    for year in (-3990, -3000, -2000, -1000, 0, 500, 1000, 1500, 1800, 1850, 1900, 1950,
                 1980, 1990, 2000, 2010, 2020, 2026, 2050, 2100, 2200, 2500, 3000, 3990):
        # Two days a year, near the extremes of the annual term and across them.
        for day in (80.25, 277.75):
            jd = 2451545.0 + round((year - 2000) * 365.25) + day
            out.write("%.2f,%.9f\n" % (jd, erfa.dtdb(jd, 0.0, 0.0, 0.0, 0.0, 0.0)))

timescale = load.timescale(builtin=True)
with open("delta_t_curve.csv", "w") as out:
    out.write("# Delta-T = TT - UT1 in seconds from the built-in curve of skyfield 1.55.\n")
    out.write("# year = 2000 + (jd_tt - 2451545) / 365.25. Made by make_time.py.\n")
    out.write("year,delta_t_s\n")
    years = list(range(-4000, 1600, 100)) + list(range(1600, 2026, 5))
    years += list(range(2026, 2040)) + list(range(2040, 2500, 20)) + list(range(2500, 4001, 100))
    for year in years:
        t = timescale.tt_jd(2451545.0 + (year - 2000) * 365.25)
        out.write("%d,%.4f\n" % (year, t.delta_t))
