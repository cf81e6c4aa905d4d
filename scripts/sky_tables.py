#!/usr/bin/env python3
"""Makes catalogs/sky/*.csv: the constellations and the objects of Messier.

    scripts/sky_tables.py DIR

DIR holds constellation_names.csv, constellation_lines.csv, constellation_bounds.csv and messier.csv,
which are the data of d3-celestial 0.7.35 as tables; catalogs/raw/bsc5.csv gives the stars.

Boundaries: corners of J2000.0 turned back to B1875.0 by the precession of 1976 (Lieske et al. 1977,
A&A 58, 1) fall on whole seconds of right ascension and whole minutes of declination, where Delporte
drew them, within 0.5"; they are rounded to them. Three points that are no corners, put into the
circle of declination +88 degrees, fall beside it and are left out. Figures: each corner takes the
HR number of the brightest star within 2' of it.
"""
import csv
import math
import pathlib
import sys

SOURCE = pathlib.Path(sys.argv[1])
CATALOGS = pathlib.Path(__file__).resolve().parent.parent / "catalogs"
ARCSEC = math.pi / 180 / 3600
CENTURIES_TO_B1875 = (2405889.25855 - 2451545.0) / 36525
STAR_WITHIN_DEG = 2 / 60
SNAP_WITHIN_ARCSEC = 0.5

# What people call them in English; recalled.
ENGLISH = """And Andromeda|Ant Air Pump|Aps Bird of Paradise|Aqr Water Bearer|Aql Eagle|Ara Altar|Ari Ram
Aur Charioteer|Boo Herdsman|Cae Chisel|Cam Giraffe|Cnc Crab|CVn Hunting Dogs|CMa Great Dog|CMi Little Dog
Cap Sea Goat|Car Keel|Cas Cassiopeia|Cen Centaur|Cep Cepheus|Cet Whale|Cha Chameleon|Cir Compasses|Col Dove
Com Berenice's Hair|CrA Southern Crown|CrB Northern Crown|Crv Crow|Crt Cup|Cru Southern Cross|Cyg Swan
Del Dolphin|Dor Swordfish|Dra Dragon|Equ Little Horse|Eri River|For Furnace|Gem Twins|Gru Crane
Her Hercules|Hor Clock|Hya Water Snake|Hyi Lesser Water Snake|Ind Indian|Lac Lizard|Leo Lion
LMi Lesser Lion|Lep Hare|Lib Scales|Lup Wolf|Lyn Lynx|Lyr Lyre|Men Table Mountain|Mic Microscope
Mon Unicorn|Mus Fly|Nor Carpenter's Square|Oct Octant|Oph Serpent Bearer|Ori Hunter|Pav Peacock
Peg Winged Horse|Per Perseus|Phe Phoenix|Pic Easel|Psc Fishes|PsA Southern Fish|Pup Stern|Pyx Compass
Ret Net|Sge Arrow|Sgr Archer|Sco Scorpion|Scl Sculptor|Sct Shield|Ser Serpent|Sex Sextant|Tau Bull
Tel Telescope|Tri Triangle|TrA Southern Triangle|Tuc Toucan|UMa Great Bear|UMi Little Bear|Vel Sails
Vir Maiden|Vol Flying Fish|Vul Little Fox"""
ENGLISH = dict(entry.split(" ", 1) for line in ENGLISH.splitlines() for entry in line.split("|"))

# Names and designations of Messier's objects that the table has otherwise or not at all; recalled.
NAMES = {24: "Sagittarius Star Cloud", 31: "Andromeda Galaxy", 33: "Triangulum Galaxy", 44: "Beehive Cluster",
    51: "Whirlpool Galaxy", 64: "Black Eye Galaxy", 73: "", 83: "Southern Pinwheel Galaxy", 101: "Pinwheel Galaxy",
    102: "Spindle Galaxy", 104: "Sombrero Galaxy"}
ALSO = {1: "Taurus A", 17: "Swan Nebula", 40: "Winnecke 4", 43: "De Mairan's Nebula", 44: "Praesepe",
    45: "Seven Sisters", 94: "Croc's Eye Galaxy", 27: "Apple Core Nebula"}
DESIGNATIONS = {24: "IC 4715", 40: "", 51: "NGC 5194", 76: "NGC 650", 45: "Melotte 22"}
TYPES = {"snr": "supernova remnant", "gc": "globular cluster", "oc": "open cluster", "sfr": "nebula",
    "pn": "planetary nebula", "rn": "reflection nebula", "s": "spiral galaxy", "e": "elliptical galaxy",
    "i": "irregular galaxy"}
OTHER_TYPES = {24: "star cloud", 40: "double star", 73: "asterism"}


def table(name):
    return list(csv.DictReader(open(SOURCE / name, encoding="utf-8")))


def write(name, columns, rows):
    with open(CATALOGS / "sky" / name, "w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


def at_b1875(ra_deg, dec_deg):
    """Seconds of right ascension and minutes of declination."""
    t = CENTURIES_TO_B1875
    zeta = (2306.2181 * t + 0.30188 * t**2 + 0.017998 * t**3) * ARCSEC
    z = (2306.2181 * t + 1.09468 * t**2 + 0.018203 * t**3) * ARCSEC
    theta = (2004.3109 * t - 0.42665 * t**2 - 0.041833 * t**3) * ARCSEC
    ra, dec = math.radians(ra_deg) + zeta, math.radians(dec_deg)
    a = math.cos(dec) * math.sin(ra)
    b = math.cos(theta) * math.cos(dec) * math.cos(ra) - math.sin(theta) * math.sin(dec)
    c = math.sin(theta) * math.cos(dec) * math.cos(ra) + math.cos(theta) * math.sin(dec)
    return math.degrees(math.atan2(a, b) + z) % 360 * 240, math.degrees(math.asin(c)) * 60


def snapped(ra_deg, dec_deg):
    """The corner on its whole numbers, or none if there is none near."""
    ra_s, dec_arcmin = at_b1875(ra_deg, dec_deg)
    corner = round(ra_s) % 86400, round(dec_arcmin)
    off = max(abs(ra_s - round(ra_s)) * 15 * math.cos(math.radians(dec_arcmin / 60)), abs(dec_arcmin - corner[1]) * 60)
    return corner if off < SNAP_WITHIN_ARCSEC else None


def rings(rows):
    """Each ring once around, without its first corner again. A closed ring begins another."""
    ring, constellation = [], None
    for row in rows:
        if row["con"] != constellation:
            assert not ring, constellation
            constellation = row["con"]
        corner = snapped(float(row["ra_deg"]), float(row["dec_deg"]))
        if corner is None:
            print("left out:", constellation, row["ra_deg"], row["dec_deg"])
        elif ring and corner == ring[0]:
            yield constellation, ring
            ring = []
        else:
            ring.append(corner)
    assert not ring


def boundaries():
    number = {}
    for constellation, ring in rings(table("constellation_bounds.csv")):
        count = number[constellation] = number.get(constellation, -1) + 1
        for a, b in zip(ring, ring[1:] + ring[:1]):
            assert (a[0] == b[0]) != (a[1] == b[1]), (constellation, a, b)
        for ra_s, dec_arcmin in ring:
            yield constellation, count, ra_s, dec_arcmin


def direction(ra_deg, dec_deg):
    ra, dec = math.radians(ra_deg), math.radians(dec_deg)
    return math.cos(dec) * math.cos(ra), math.cos(dec) * math.sin(ra), math.sin(dec)


def figures():
    stars = [row for row in csv.DictReader(open(CATALOGS / "raw" / "bsc5.csv", encoding="utf-8")) if row["ra_deg_j2000"]]
    places = [direction(float(s["ra_deg_j2000"]), float(s["dec_deg_j2000"])) for s in stars]
    near = math.cos(math.radians(STAR_WITHIN_DEG))
    without = 0
    for row in table("constellation_lines.csv"):
        here = direction(float(row["ra_deg"]), float(row["dec_deg"]))
        close = [s for s, p in zip(stars, places) if sum(a * b for a, b in zip(here, p)) > near]
        star = min(close, key=lambda s: float(s["vmag"]), default=None)
        without += star is None
        if star is None:
            print("no star:", row)
        yield row["con"], row["polyline"], star["hr"] if star else "", row["ra_deg"], row["dec_deg"]
    print("corners without a star:", without)


def names():
    rows = table("constellation_names.csv")
    for con in sorted({row["con"] for row in rows}, key=lambda con: next(r["latin"] for r in rows if r["con"] == con)):
        mine = [row for row in rows if row["con"] == con]
        latin = mine[0]["latin"] if len(mine) == 1 else mine[0]["latin"].split()[0]
        labels = " ".join(f'{row["label_ra_deg"]} {row["label_dec_deg"]}' for row in mine)
        yield con, latin, mine[0]["genitive"], ENGLISH[con], labels


def messier():
    for row in table("messier.csv"):
        number = int(row["m"][1:])
        name = NAMES.get(number, row["name"]).replace("´", "'").replace("’", "'")
        kind = OTHER_TYPES.get(number) or TYPES[row["type"]]
        size = (row["dim_arcmin"].split("x") + row["dim_arcmin"].split("x"))[:2]
        designation = DESIGNATIONS.get(number, row["desig"])
        yield number, designation, name, ALSO.get(number, ""), kind, row["vmag"], *size, row["ra_deg"], row["dec_deg"]


write("constellations.csv", ["abbreviation", "latin", "genitive", "english", "labels_ra_dec_deg"], names())
write("figures.csv", ["abbreviation", "line", "hr", "ra_deg", "dec_deg"], figures())
write("boundaries.csv", ["abbreviation", "ring", "ra_s", "dec_arcmin"], boundaries())
write("messier.csv", ["number", "designation", "name", "also", "kind", "v", "length_arcmin", "width_arcmin",
    "ra_deg", "dec_deg"], messier())
