#!/usr/bin/env python3
"""The Moon of the same instants and places by this program and by Stellarium, side by side.

Both draw it, both say where it is, and both pictures are measured by the same code: the ellipse of the
limb, the axis of its lit part, and where craters of one picture stand on the other. PyEphem is asked
too, as a third opinion of places. The pictures go to docs/moon/side_by_side/, the tables into
docs/moon_side_by_side.md between its marks. Run by scripts/side_by_side.sh, which installs what this
needs: numpy, pillow, OpenEXR, ephem, Stellarium and Xvfb.
"""

import argparse
import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import ephem
import numpy as np
import OpenEXR
from PIL import Image, ImageDraw

PAGE = Path("docs/moon_side_by_side.md")
PICTURES = Path("docs/moon/side_by_side")
WORK = Path("target/side_by_side")
STELLARIUM_DEFAULTS = Path("/usr/share/stellarium/data/default_cfg.ini")
AU_KM = 149_597_870.7
# Pressure and temperature that our air has at these heights without further word: US Standard
# Atmosphere 1976, and 10 degrees at the sea. Stellarium is told the same.
PLACES = {
    "Flagstaff": dict(lon=-111.65127, lat=35.19807, height_m=2108.0),
    "Honolulu": dict(lon=-157.85833, lat=21.30694, height_m=18.0),
}
# Name, instant (UTC), place, field (degrees across), pixels drawn across, exposure of ours (stops).
SCENES = [
    ("crescent", "2026-07-17T04:00:00", "Flagstaff", 0.65, 600, 0.0),
    ("quarter", "2026-08-20T03:30:00", "Flagstaff", 0.56, 2250, -2.0),
    ("low", "2026-08-29T05:27:00", "Honolulu", 0.65, 600, 0.0),
    ("day", "2026-06-23T00:30:00", "Flagstaff", 0.65, 600, 0.0),
    ("partial", "2026-03-03T10:30:00", "Flagstaff", 0.65, 600, 0.0),
    ("total", "2026-03-03T11:33:42", "Flagstaff", 0.65, 600, 0.0),
    ("full", "2026-05-31T07:30:00", "Flagstaff", 0.65, 600, -2.0),
]
# What is cut out of the quarter, at full size: left, top, right, bottom.
CROP = (1000, 900, 1900, 1800)
DETAIL = (1120, 270, 1720, 870)
# Scenes whose light is shown as it is, too.
PLAIN = ("low", "total", "full")
# Craters looked for on both pictures.
CRATERS = {
    "quarter": ["Theophilus", "Posidonius", "Plinius", "Aristoteles", "Eudoxus"],
    "full": ["Tycho", "Copernicus", "Aristarchus", "Kepler", "Proclus"],
}


def weather(height_m):
    """Pressure, mbar, and temperature, degrees C, that our air has at a height."""
    pressure = 1013.25 * (1.0 - 2.25577e-5 * height_m) ** 5.25588
    return pressure, 10.0 - 0.0065 * height_m


# --- Ours ---------------------------------------------------------------------------------------


def run_ours(nocturne, scene):
    name, instant, place, field, px, stops = scene
    out = WORK / "ours"
    out.mkdir(parents=True, exist_ok=True)
    at = instant + "Z"
    subprocess.run(
        [nocturne, "render", "--at", at, "--place", place, "--look", "Moon", "--fov", str(field),
         "--size", f"{px}x{px}", "--no-marks", f"--exposure={stops}", "-o", out / f"{name}.png",
         "-o", out / f"{name}.exr", "--describe", out / f"{name}.json", "--quiet"],
        check=True,
    )
    rows = subprocess.run(
        [nocturne, "ephemeris", "--body", "Moon", "--from", at, "--place", place, "--format", "jsonl"],
        check=True, capture_output=True, text=True,
    ).stdout
    return json.loads(rows.splitlines()[0]), json.loads((out / f"{name}.json").read_text())


def light_of(path):
    """Channels of an EXR, cd/m2, by name."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: np.asarray(channel.pixels, float) for name, channel in file.channels().items()}


# --- Stellarium ---------------------------------------------------------------------------------


def stellarium_script(scenes, out):
    lines = [
        'core.clear("natural"); core.setGuiVisible(false); core.setTimeRate(0);',
        'function attempt(f) { try { f(); } catch (e) { core.output("SKIPPED " + e); } }',
    ]
    for call in [
        "LandscapeMgr.setFlagAtmosphere(true)", "LandscapeMgr.setFlagLandscape(false)",
        "LandscapeMgr.setFlagFog(false)", "LandscapeMgr.setFlagCardinalPoints(false)",
        "SolarSystem.setFlagLabels(false)", "SolarSystem.setFlagHints(false)",
        "SolarSystem.setFlagPointer(false)", "NomenclatureMgr.setFlagLabels(false)",
        "StelMovementMgr.setEquatorialMount(false)", 'core.setSelectedObjectInfo("none")',
        'core.setProjectionMode("ProjectionStereographic")',
    ]:
        lines.append(f"attempt(function() {{ {call}; }});")
    for index, (name, instant, place, field, *_) in enumerate(scenes):
        p = PLACES[place]
        # Its textures come late, and until then one is drawn in the place of another.
        patience_s = 15 if index == 0 else 4
        pressure, temperature = weather(p["height_m"])
        lines += [
            f"core.setObserverLocation({p['lon']},{p['lat']},{p['height_m']},0,\"{place}\",\"Earth\");",
            f'core.setDate("{instant}","utc");',
            f"StelSkyDrawer.setAtmospherePressure({pressure:.2f});",
            f"StelSkyDrawer.setAtmosphereTemperature({temperature:.2f});",
            'core.wait(0.5); core.selectObjectByName("Moon",false);',
            # Said twice: a first jump may start from where the Moon stood before.
            "StelMovementMgr.setFlagTracking(true); core.wait(1); core.moveToSelectedObject(0);",
            "core.wait(0.5); core.moveToSelectedObject(0);",
            f"StelMovementMgr.zoomTo({field},0); core.wait({patience_s});",
            f'core.screenshot("{name}",false,"{out}",true); core.wait(1);',
            'var m = core.getObjectInfo("Moon");',
            f'for (var k in m) core.output("DATA {name} " + k + " = " + m[k] + "\\n");',
        ]
    lines.append("core.quitStellarium();")
    return "\n".join(lines)


def run_stellarium(scenes, px):
    """Screenshots and what Stellarium says of the Moon, by scene."""
    folder = (WORK / f"stellarium_{px}").resolve()
    shutil.rmtree(folder, ignore_errors=True)
    out = folder / "out"
    out.mkdir(parents=True)
    (folder / "home").mkdir()
    script = folder / "moon.ssc"
    script.write_text(stellarium_script(scenes, out))
    # The settings that Stellarium comes with, in a window of our size and without its plug-ins.
    settings = STELLARIUM_DEFAULTS.read_text()
    for key, value in dict(
        fullscreen="false", screen_w=px, screen_h=px, minimum_fps=2, maximum_fps=10,
        check_requirements="false", Exoplanets="false", FOV="false", MeteorShowers="false",
        Novae="false", Oculars="false", Satellites="false", SolarSystemEditor="false",
    ).items():
        settings = re.sub(rf"(?m)^{key}\s*=.*$", f"{key} = {value}", settings)
    (folder / "config.ini").write_text(settings)
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{px}x{px}x24", "-nolisten", "tcp"],
        pass_fds=[write], stderr=subprocess.DEVNULL,
    )
    os.close(write)
    try:
        display = os.read(read, 32).decode().strip()
        if not display:
            sys.exit("Xvfb did not start: run it by hand and see what it says.")
        environment = dict(
            os.environ, DISPLAY=f":{display}", LIBGL_ALWAYS_SOFTWARE="1", QT_QPA_PLATFORM="xcb",
            HOME=str(folder / "home"), vblank_mode="0",
        )
        with open(folder / "log.txt", "w") as log:
            subprocess.run(
                ["stellarium", "--user-dir", folder, "--startup-script", script],
                env=environment, stdout=log, stderr=log, timeout=240, check=False,
            )
    except subprocess.TimeoutExpired:
        sys.exit(f"Stellarium did not end its script in four minutes; {folder / 'log.txt'} may say why.")
    finally:
        server.terminate()
        server.wait()
    said = {}
    for line in (folder / "output.txt").read_text().splitlines():
        if match := re.match(r"DATA (\S+) (\S+) = (.*)", line):
            said.setdefault(match[1], {})[match[2]] = match[3]
    pictures = {}
    for scene in scenes:
        path = out / f"{scene[0]}.png"
        if not path.exists():
            sys.exit(f"Stellarium left no picture {path}; {folder / 'log.txt'} may say why.")
        pictures[scene[0]] = Image.open(path).convert("RGB")
        if scene[0] in ("quarter", "full") and is_violet(pictures[scene[0]]):
            sys.exit(f"Stellarium drew {path} before its textures were there: run this again.")
        if pictures[scene[0]].size != (px, px):
            print(f"{path} is {pictures[scene[0]].size} instead of {px} pixels", file=sys.stderr)
    return said, pictures


def is_violet(picture):
    """Whether the bright part is as violet as a map of slopes, which stands in for a late texture."""
    pixels = np.asarray(picture, float).reshape(-1, 3)
    bright = pixels[pixels.sum(axis=1) >= np.percentile(pixels.sum(axis=1), 90)].mean(axis=0)
    return bright[2] > 1.4 * bright[1]


# --- Measuring pictures -------------------------------------------------------------------------


def luminance(picture):
    """Relative luminance of an sRGB picture."""
    c = np.asarray(picture, float) / 255.0
    linear = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    return linear @ [0.2126, 0.7152, 0.0722]


def brightness(picture):
    return np.asarray(picture, float) @ [0.299, 0.587, 0.114]


def as_a_screen_would(light):
    """Brightness of light, 0 to 255, with the brightest few thousandths white: no eye, no glare."""
    return 255.0 * np.clip(light["Y"] / np.percentile(light["Y"], 99.7), 0.0, 1.0) ** (1 / 2.2)


def plain(light):
    """The light as a picture, white as bright as its brightest few thousandths: no eye, no glare."""
    to_rgb = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])
    rgb = np.stack([light[c] for c in "XYZ"], axis=-1) @ to_rgb.T
    rgb = np.clip(rgb / np.percentile(light["Y"], 99.7), 0.0, 1.0)
    encoded = np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * rgb ** (1 / 2.4) - 0.055)
    return Image.fromarray((255 * encoded).round().astype("uint8"))


def sample(image, x, y):
    """Bilinear; pixel centres at half integers."""
    x, y = np.clip(x - 0.5, 0, image.shape[1] - 1.001), np.clip(y - 0.5, 0, image.shape[0] - 1.001)
    i, j = x.astype(int), y.astype(int)
    u, v = x - i, y - j
    return ((1 - u) * (1 - v) * image[j, i] + u * (1 - v) * image[j, i + 1]
            + (1 - u) * v * image[j + 1, i] + u * v * image[j + 1, i + 1])


def limb(image, radius):
    """Points of the steepest fall of brightness near the expected limb, by angle, and its depth.

    Angles from up, anticlockwise, as position angles go; x right, y down, pixels.
    """
    centre = np.array(image.shape[::-1]) / 2.0
    angles = np.radians(np.arange(0, 360, 1.0))
    radii = np.arange(0.80 * radius, 1.06 * radius, max(radius / 600, 0.25))
    x = centre[0] - np.sin(angles)[:, None] * radii
    y = centre[1] - np.cos(angles)[:, None] * radii
    profile = sample(image, x, y)
    width = max(1, int(round(0.012 * radius / (radii[1] - radii[0]))))
    fall = profile[:, :-width] - profile[:, width:]
    best = fall.argmax(axis=1)
    # The middle of the fall that is half as steep or more, for a fraction of a pixel.
    steps = np.arange(fall.shape[1])
    middle = np.array([
        np.average(steps, weights=np.where((f >= 0.5 * f[b]) & (abs(steps - b) <= 2 * width), f, 0.0))
        for f, b in zip(np.maximum(fall, 1e-9), best)
    ])
    r = radii[0] + (middle + width / 2) * (radii[1] - radii[0])
    depth = fall.max(axis=1)
    return angles, centre[0] - np.sin(angles) * r, centre[1] - np.cos(angles) * r, depth


def ellipse(x, y):
    """Centre, half width and half height of the upright ellipse through points; robust."""
    keep = np.ones(len(x), bool)
    for _ in range(6):
        # x^2 + b y^2 + c x + d y + e = 0
        rows = np.stack([y[keep] ** 2, x[keep], y[keep], np.ones(keep.sum())], axis=1)
        b, c, d, e = np.linalg.lstsq(rows, -x[keep] ** 2, rcond=None)[0]
        x0, y0 = -c / 2, -d / (2 * b)
        a2 = x0**2 + b * y0**2 - e
        half = math.sqrt(max(a2, 1e-9)), math.sqrt(max(a2 / b, 1e-9))
        off = np.hypot((x - x0) / half[0], (y - y0) / half[1]) - 1
        keep = abs(off) < max(2.5 * np.median(abs(off[keep])), 0.002)
    return x0, y0, half[0], half[1]


def circle(x, y):
    keep = np.ones(len(x), bool)
    for _ in range(6):
        rows = np.stack([x[keep], y[keep], np.ones(keep.sum())], axis=1)
        c, d, e = np.linalg.lstsq(rows, -(x[keep] ** 2 + y[keep] ** 2), rcond=None)[0]
        r = math.sqrt((c * c + d * d) / 4 - e)
        off = np.hypot(x + c / 2, y + d / 2) / r - 1
        keep = abs(off) < max(2.5 * np.median(abs(off[keep])), 0.002)
    return -c / 2, -d / 2, r, r


def measure(image, radius, whole):
    """Ellipse of the limb (a circle where only a part is lit), axis and length of the lit limb."""
    angles, x, y, depth = limb(image, radius)
    lit = depth > (0.10 if whole else 0.25) * np.percentile(depth, 95)
    shape = (ellipse if whole else circle)(x[lit], y[lit])
    return shape, lit_axis(angles, depth), lit.mean() * 360.0


def lit_axis(angles, depth):
    """Axis about which the lit limb is most nearly its own mirror image, degrees from up, anticlockwise.

    Bright and dark ground at the limb leave it uncertain by some 1.5 degrees.
    """
    depth = np.clip(depth, 0.0, 0.4 * np.percentile(depth, 95))
    about = math.degrees(math.atan2((depth * np.sin(angles)).sum(), (depth * np.cos(angles)).sum()))
    aside = np.arange(0.0, 120.0)

    def at(degrees):
        return np.interp(degrees, np.degrees(angles), depth, period=360.0)

    axes = about + np.arange(-20.0, 20.0, 0.25)
    return axes[np.argmin([((at(c + aside) - at(c - aside)) ** 2).sum() for c in axes])] % 360.0


def find_patch(ours, theirs, x, y, half, reach):
    """How far a patch of ours about x, y is displaced on theirs, pixels, and its correlation."""
    i, j = int(round(x - 0.5)), int(round(y - 0.5))
    patch = ours[j - half:j + half + 1, i - half:i + half + 1]
    patch = patch - patch.mean()
    score = np.full((2 * reach + 1, 2 * reach + 1), -1.0)
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            other = theirs[j + dy - half:j + dy + half + 1, i + dx - half:i + dx + half + 1]
            if other.shape != patch.shape:
                continue
            other = other - other.mean()
            size = math.sqrt((patch**2).sum() * (other**2).sum() + 1e-12)
            score[dy + reach, dx + reach] = (patch * other).sum() / size
    best = np.unravel_index(score.argmax(), score.shape)
    offset = []
    for axis in (1, 0):
        at = best[axis]
        line = score[best[0], :] if axis == 1 else score[:, best[1]]
        if 0 < at < 2 * reach:
            l, m, h = line[at - 1], line[at], line[at + 1]
            at = at + 0.5 * (l - h) / (l - 2 * m + h)
        offset.append(at - reach)
    return offset[0], offset[1], score.max()


# --- Tables -------------------------------------------------------------------------------------


def bright_limb_from_up(sun_az, sun_alt, az, alt):
    """Direction from the Moon to the Sun, degrees from up, anticlockwise on the picture."""
    d = math.radians(sun_az - az)
    a, b = math.radians(sun_alt), math.radians(alt)
    east = math.cos(a) * math.sin(d)
    up = math.sin(a) * math.cos(b) - math.cos(a) * math.sin(b) * math.cos(d)
    return math.degrees(math.atan2(-east, up)) % 360


def wrap(degrees):
    return (degrees + 180.0) % 360.0 - 180.0


def pyephem(instant, place):
    p = PLACES[place]
    site = ephem.Observer()
    site.lon, site.lat, site.elevation = str(p["lon"]), str(p["lat"]), p["height_m"]
    site.pressure = 0
    site.date = instant.replace("T", " ").replace("-", "/")
    moon, sun = ephem.Moon(site), ephem.Sun(site)
    deg = math.degrees
    return dict(az=deg(moon.az), alt=deg(moon.alt), sun_az=deg(sun.az), sun_alt=deg(sun.alt),
                size=float(moon.size) / 3600.0, lit=float(moon.phase),
                libration_lon=deg(moon.libration_long), libration_lat=deg(moon.libration_lat),
                colongitude=deg(moon.colong), subsolar_lat=deg(moon.subsolar_lat))


def number(text):
    match = re.match(r"[-+0-9.eE]+", text)
    return float(match[0]) if match else math.nan


def cell(value, digits):
    return "" if value is None or math.isnan(value) else f"{value:.{digits}f}"


def numbers_table(row, describe, said, third):
    moon = next(o for o in describe["objects"] if o["name"] == "Moon")
    s = {key: number(value) for key, value in said.items()}
    phase = phase_at_place(row)
    rows = [
        ("azimuth, deg", row["az_deg"], s["azimuth-geometric"], third["az"], 4),
        ("altitude without air, deg", row["alt_deg_airless"], s["altitude-geometric"], third["alt"], 4),
        ("altitude through air, deg", moon["apparent_altitude_deg"], s["altitude"], None, 4),
        ("distance from the place, km", row["topo_dist_km"], s["distance"] * AU_KM, None, 0),
        ("diameter, arcmin", row["topo_ang_diam_arcsec"] / 60, s["size-dd"] * 60, third["size"] * 60, 3),
        ("phase angle from the place, deg", phase, s["phase-angle-deg"], None, 2),
        ("lit, seen from the place, %", 50 * (1 + math.cos(math.radians(phase))), s["phase"] * 100, None, 2),
        ("lit, seen from the Earth's centre, %", row["illum_frac"] * 100, None, third["lit"], 2),
        ("libration in longitude from the Earth's centre, deg", row["geo_libr_lon_deg"],
         wrap(s["libration_l"]), third["libration_lon"], 3),
        ("libration in latitude from the Earth's centre, deg", row["geo_libr_lat_deg"],
         wrap(s["libration_b"]), third["libration_lat"], 3),
        ("libration in longitude from the place, deg", row["topo_libr_lon_deg"], None, None, 3),
        ("libration in latitude from the place, deg", row["topo_libr_lat_deg"], None, None, 3),
        ("colongitude, deg", row["colongitude_deg"], (90.0 - s["subsolar_l"]) % 360, third["colongitude"], 3),
        ("latitude under the Sun, deg", row["subsolar_lat_deg"], wrap(s["subsolar_b"]), third["subsolar_lat"], 3),
        ("position angle of the axis from the Earth's centre, deg", wrap(row["axis_PA_deg"]),
         wrap(s["pa_axis"]), None, 3),
        ("position angle of the axis from the place, deg", wrap(row["topo_axis_PA_deg"]), None, None, 3),
        ("magnitude outside the air", moon["magnitude_v"], s["vmag"], None, 2),
        ("magnitude through the air", ground_magnitude(moon), s["vmage"], None, 2),
    ]
    lines = ["| | Nocturne | Stellarium | difference | PyEphem |", "|---|---|---|---|---|"]
    for label, ours, theirs, other, digits in rows:
        if theirs is None:
            lines.append(f"| {label} | {cell(ours, digits)} | | | {cell(other, digits)} |")
            continue
        difference = theirs - ours
        if "deg" in label and abs(difference) > 180:
            difference = wrap(difference)
        lines.append(f"| {label} | {cell(ours, digits)} | {cell(theirs, digits)} | {difference:+.{digits}f} | {cell(other, digits)} |")
    return lines


def phase_at_place(row):
    """Angle at the Moon between the place and the Sun, degrees: between the points below both."""
    a, b = math.radians(row["topo_libr_lat_deg"]), math.radians(row["subsolar_lat_deg"])
    d = math.radians(row["topo_libr_lon_deg"] - row["subsolar_lon_deg"])
    return math.degrees(math.acos(math.sin(a) * math.sin(b) + math.cos(a) * math.cos(b) * math.cos(d)))


def ground_magnitude(moon):
    """From lux on a surface that faces the Moon, by the same zero as outside the air."""
    outside, ground = moon["illuminance_lx"], moon.get("illuminance_ground_lx")
    if not ground or not outside:
        return math.nan
    return moon["magnitude_v"] - 2.5 * math.log10(ground / outside)


def flattening(describe):
    """Height of the Moon through air over that without, by our places on it and by Saemundsson 1986.

    The formula, in arcminutes at 1010 mbar and 10 degrees C, is that of Meeus 1998, (16.4), recalled.
    """
    moon = next(o for o in describe["objects"] if o["name"] == "Moon")
    near = [f for f in describe["moon_features"] if f["is_on_near_side"]]
    airless = np.array([f["altitude_deg"] for f in near])
    through = np.array([f["apparent_altitude_deg"] for f in near])
    fit = np.polyfit(airless - moon["altitude_deg"], through, 3)
    pressure, temperature = weather(describe["place"]["height_m"])

    def refraction_deg(h):
        scale = pressure / 1010 * 283 / (273 + temperature)
        return 1.02 / 60 * scale / math.tan(math.radians(h + 10.3 / (h + 5.11)))

    half = 0.2575
    h = moon["altitude_deg"]
    chord = np.polyval(fit, half) - np.polyval(fit, -half)
    return chord / (2 * half), 1 + (refraction_deg(h + half) - refraction_deg(h - half)) / (2 * half)


def measured_table(name, describe, ours, theirs, expected_px, limb_expected):
    whole = name in ("low", "total", "full")
    a, mid_a, span_a = measure(ours, expected_px, whole)
    b, mid_b, span_b = measure(theirs, expected_px, whole)
    lines = ["| measured on our EXR and Stellarium's picture | Nocturne | Stellarium | difference |", "|---|---|---|---|"]

    def put(label, u, v, digits):
        lines.append(f"| {label} | {u:.{digits}f} | {v:.{digits}f} | {v - u:+.{digits}f} |")

    put("centre right of the middle, px", a[0] - ours.shape[1] / 2, b[0] - theirs.shape[1] / 2, 2)
    put("centre below the middle, px", a[1] - ours.shape[0] / 2, b[1] - theirs.shape[0] / 2, 2)
    if whole:
        put(f"half width, px (expected {expected_px:.1f})", a[2], b[2], 1)
        put("height over width", a[3] / a[2], b[3] / b[2], 4)
        if name == "low":
            own, formula = flattening(describe)
            put(f"height over the diameter without air (by `--describe` {own:.3f}, by Saemundsson {formula:.3f})",
                a[3] / expected_px, b[3] / expected_px, 3)
    else:
        put(f"radius, px (expected {expected_px:.1f})", a[2], b[2], 1)
    if name in ("crescent", "quarter", "day"):
        put(f"axis of the lit limb from up, to 1.5 deg (Sun at {limb_expected:.2f})", mid_a, mid_b, 1)
        put("lit limb spans, deg", span_a, span_b, 0)
    return lines


def colour_table(name, light, ours, theirs, radius):
    """Light of ours, and mean colours of both pictures inside the disc and beside it."""
    y, x = np.indices(light["Y"].shape)
    away = np.hypot(x + 0.5 - light["Y"].shape[1] / 2, y + 0.5 - light["Y"].shape[0] / 2)
    disc = away < (0.85 if name == "low" else 0.97) * radius
    sky = away > 1.1 * radius
    luminances = light["Y"][disc]
    lines = ["| light of ours (EXR), cd/m2 | |", "|---|---|"]
    lines.append(f"| sky beside the Moon, median | {np.median(light['Y'][sky]):.3g} |")
    for label, share in (("brightest 1 %", 99), ("median", 50), ("darkest 1 %", 1)):
        lines.append(f"| disc, {label} | {np.percentile(luminances, share):.3g} |")
    whole = name in ("low", "total", "full")
    if whole:
        low, high = np.percentile(luminances, [5, 95])
        lines.append(f"| disc, 95th over 5th hundredth | {high / low:.1f} |")
    total = sum(light[c][disc].sum() for c in "XYZ")
    lines.append(f"| chromaticity of the disc's light, x y | {light['X'][disc].sum() / total:.3f} {light['Y'][disc].sum() / total:.3f} |")

    def mean(picture, mask):
        return " ".join(f"{v:.0f}" for v in np.asarray(picture, float)[mask].mean(axis=0))

    lines += ["", "| mean sRGB of the pictures | Nocturne | Stellarium |", "|---|---|---|"]
    lines.append(f"| disc | {mean(ours, disc)} | {mean(theirs, disc)} |")
    lines.append(f"| sky beside it | {mean(ours, sky)} | {mean(theirs, sky)} |")
    if not whole:
        return lines
    a, b = (np.percentile(luminance(picture)[disc], [5, 95]) for picture in (ours, theirs))
    lines.append(f"| luminance on the screen, 95th over 5th hundredth of the disc | {a[1] / max(a[0], 1e-4):.1f} | {b[1] / max(b[0], 1e-4):.1f} |")
    return lines


def crater_table(name, describe, ours, theirs, px_per_deg):
    features = {f["name"]: f for f in describe["moon_features"]}
    half, reach = (30, 24) if ours.shape[0] > 1000 else (14, 12)
    lines = ["| crater | x, y by `--describe`, px | moved on Stellarium's, px | that is, arcsec | correlation |",
             "|---|---|---|---|---|"]
    for crater in CRATERS[name]:
        f = features[crater]
        dx, dy, score = find_patch(ours, theirs, f["x_px"], f["y_px"], half, reach)
        arcsec = math.hypot(dx, dy) / px_per_deg * 3600
        lines.append(f"| {crater} | {f['x_px']:.1f}, {f['y_px']:.1f} | {dx:+.1f}, {dy:+.1f} | {arcsec:.1f} | {score:.2f} |")
    return lines


# --- Pictures and page --------------------------------------------------------------------------


def save(picture, name):
    picture.save(PICTURES / name, optimize=True)


def marked(picture, describe, box, names, radius):
    """A detail with a ring where `--describe` says that a crater is, on a Moon of this radius, pixels."""
    detail = picture.crop(box)
    draw = ImageDraw.Draw(detail)
    for f in describe["moon_features"]:
        if f["name"] in names:
            x, y = f["x_px"] - box[0], f["y_px"] - box[1]
            r = f["diameter_km"] / 2 / 1737.4 * radius
            draw.ellipse([x - r, y - r, x + r, y + r], outline=(255, 0, 0), width=2)
            draw.text((x + r + 3, y - 6), f["name"], fill=(255, 0, 0))
    return detail


def write_table(page, mark, lines):
    pattern = re.compile(rf"(<!-- {mark} -->\n).*?(<!-- end -->)", re.S)
    if not pattern.search(page):
        sys.exit(f"The page {PAGE} has no place for the table {mark}.")
    return pattern.sub(lambda m: m[1] + "\n".join(lines) + "\n" + m[2], page)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--nocturne", default="target/release/nocturne")
    parser.add_argument("--keep", action="store_true", help="take what Stellarium said and drew last time")
    options = parser.parse_args()
    WORK.mkdir(parents=True, exist_ok=True)
    PICTURES.mkdir(parents=True, exist_ok=True)

    said, shots = {}, {}
    kept = WORK / "said.json"
    for px in sorted({scene[4] for scene in SCENES}):
        scenes = [scene for scene in SCENES if scene[4] == px]
        if options.keep and kept.exists():
            said = json.loads(kept.read_text())
            for scene in scenes:
                shots[scene[0]] = Image.open(WORK / f"stellarium_{px}/out/{scene[0]}.png").convert("RGB")
        else:
            print(f"Stellarium, {px} pixels: {', '.join(s[0] for s in scenes)}", flush=True)
            words, pictures = run_stellarium(scenes, px)
            said.update(words)
            shots.update(pictures)
    kept.write_text(json.dumps(said))

    page = PAGE.read_text()
    for scene in SCENES:
        name, instant, place, field, px, _ = scene
        print(f"Nocturne: {name}", flush=True)
        row, describe = run_ours(options.nocturne, scene)
        ours, theirs = Image.open(WORK / f"ours/{name}.png").convert("RGB"), shots[name]
        light = light_of(WORK / f"ours/{name}.exr")
        third = pyephem(instant, place)
        radius = row["topo_ang_diam_arcsec"] / 7200 / field * px
        sun = next(o for o in describe["objects"] if o["name"] == "Sun")
        limb_at = bright_limb_from_up(sun["azimuth_deg"], sun["altitude_deg"], row["az_deg"], row["alt_deg_airless"])
        lines = numbers_table(row, describe, said[name], third)
        lines += [""] + measured_table(name, describe, as_a_screen_would(light), brightness(theirs), radius, limb_at)
        if name in CRATERS:
            lines += [""] + crater_table(name, describe, as_a_screen_would(light), brightness(theirs), px / field)
        lines += [""] + colour_table(name, light, ours, theirs, radius)
        page = write_table(page, name, lines)
        for who, picture in (("ours", ours), ("stellarium", theirs), ("light", plain(light))):
            if name == "quarter":
                if who != "light":
                    save(picture.resize((600, 600), Image.Resampling.LANCZOS), f"quarter_{who}.png")
                    save(picture.crop(CROP), f"quarter_crop_{who}.png")
                save(marked(picture, describe, DETAIL, CRATERS[name], radius), f"quarter_detail_{who}.png")
            elif who != "light" or name in PLAIN:
                save(picture, f"{name}_{who}.png")
    PAGE.write_text(page)
    size = sum(p.stat().st_size for p in PICTURES.iterdir())
    print(f"Wrote {PAGE} and {PICTURES} ({size / 1e6:.1f} MB)")


if __name__ == "__main__":
    main()
