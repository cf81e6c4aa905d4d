"""Fits the series of `src/ephemeris/deep_moon.rs` to JPL DE431, -3001 to +3001, and writes its tables.

    pip install numpy
    python3 scripts/de431_moon.py target/kernels/de431_samples.bin src/ephemeris/deep_moon

Longitude, latitude and distance in the ecliptic of date are sums of sines and cosines of whole
multiples of ten arguments, times powers of time. Terms are found one after the other: the largest lines
in the spectrum of what is left, each given to that combination of the arguments which follows its phase
best over all six millennia, the simplest first. Then all coefficients and the polynomials of the Moon's
own arguments are fitted together (least squares). An hour on one core.
"""

import itertools
import struct
import sys

import numpy as np
from numpy.polynomial import chebyshev, polynomial

ARCSEC = np.pi / 180 / 3600
OBLIQUITY = 84381.406 * ARCSEC
DISTANCE_KM = 384400.0
# Time runs from -1 to +1: centuries from J2000.0 to the middle of the span, and half of it.
MIDDLE, HALF = -20.0, 30.02
DEGREE = 7
POLE_DEGREE = 6

# Arguments, degrees by powers of centuries from J2000.0: the Moon's elongation from the Sun, the Sun's
# anomaly, the Moon's anomaly and argument of latitude (Meeus 1998, chapter 47), the mean longitudes of
# Venus, the Earth, Mars, Jupiter and Saturn (Simon et al. 1994, equinox J2000.0), general precession
# (Capitaine et al. 2003).
PRECESSION = [0, 5028.796195 / 3600, 1.1054348 / 3600, 0.00007964 / 3600, -0.000023857 / 3600]
ARGUMENTS = [
    ("D", [297.8501921, 445267.1114034, -0.0018819, 1 / 545868, -1 / 113065000]),
    ("l'", [357.5291092, 35999.0502909, -0.0001536, 1 / 24490000]),
    ("l", [134.9633964, 477198.8675055, 0.0087414, 1 / 69699, -1 / 14712000]),
    ("F", [93.2720950, 483202.0175233, -0.0036539, -1 / 3526000, 1 / 863310000]),
    ("Ve", [181.97980085, 58517.8156760]),
    ("Te", [100.46645683, 35999.3728565]),
    ("Ma", [355.43299958, 19140.2993039]),
    ("Ju", [34.35151874, 3034.9056606]),
    ("Sa", [50.07744430, 1222.1138488]),
    ("p", PRECESSION),
]
NONE = (0,) * len(ARGUMENTS)
# Mean longitude from the equinox of date; less precession it counts from a point that stands still.
LONGITUDE = [218.31665436, 481267.88123421, -0.0015786, 1 / 538841, -1 / 65194000]
FITTED = ["L", "D", "l", "F"]
# New terms of longitude, latitude and distance in each round; smaller lines than this are left.
ROUNDS = [(8, 6, 6), (30, 20, 20), (80, 50, 50), (100, 60, 50), (120, 60, 50), (120, 60, 40), (100, 40, 0),
          (60, 30, 0)]
SMALLEST_ARCSEC = 0.006
# The first few terms would bend the arguments.
FIRST_ROUND_WITH_ARGUMENTS = 3
# Until the arguments fit, powers of time would stand for their faults.
FIRST_ROUND_WITH_POWERS = 4
# The fastest terms take more than three days for a turn.
STEP_DAYS = 1.5
FIT_POINTS = 120_000


class Samples:
    """The positions that `de431_samples.py` wrote, interpolated."""

    def __init__(self, path):
        with open(path, "rb") as file:
            mark, count = struct.unpack("<8sI", file.read(12))
            if mark != b"DE431SMP":
                sys.exit(f"{path}: no file of de431_samples.py")
            heads = [struct.unpack("<16s3d2I", file.read(48)) for _ in range(count)]
            self.channels = {}
            for name, begin, days, unit_km, blocks, nodes in heads:
                places = np.frombuffer(file.read(blocks * nodes * 12), "<i4")
                places = places.reshape(blocks, nodes, 3) * unit_km
                x = -np.cos(np.pi * (np.arange(nodes) + 0.5) / nodes)
                inverse = np.linalg.inv(chebyshev.chebvander(x, nodes - 1))
                name = name.rstrip(b"\0").decode()
                self.channels[name] = begin, days, np.einsum("jk,ikc->ijc", inverse, places)

    def km(self, name, jd):
        begin, days, coefficients = self.channels[name]
        block = ((jd - begin) / days).astype(int)
        x = 2 * ((jd - begin) / days - block) - 1
        place = np.empty((len(jd), 3))
        for part in range(0, len(jd), 100_000):
            part = slice(part, part + 100_000)
            values = chebyshev.chebvander(x[part], coefficients.shape[1] - 1)
            place[part] = np.einsum("ij,ijc->ic", values, coefficients[block[part]])
        return place


def centuries(jd):
    return (jd - 2451545.0) / 36525


def scaled(jd):
    return (centuries(jd) - MIDDLE) / HALF


def to_ecliptic_j2000(place):
    cos, sin = np.cos(OBLIQUITY), np.sin(OBLIQUITY)
    x, y, z = place.T
    return np.stack([x, cos * y + sin * z, cos * z - sin * y], 1)


def pole_of_ecliptic(samples, jd):
    """Two coordinates of the pole of the orbit of Earth and Moon: Chebyshev polynomials of scaled time."""
    inner = jd[20:-20:7]
    before, here, after = (samples.km("earth-moon", inner + shift) for shift in (-1, 0, 1))
    pole = np.cross(to_ecliptic_j2000(here), to_ecliptic_j2000(after - before))
    pole /= np.linalg.norm(pole, axis=1)[:, None]
    return chebyshev.chebfit(scaled(inner), pole[:, :2], POLE_DEGREE)


def to_ecliptic_of_date(place, pole, jd):
    """The smallest rotation that takes the pole of date to z."""
    px, py = chebyshev.chebval(scaled(jd), pole)
    x, y, z = to_ecliptic_j2000(place).T
    along = px * x + py * y
    height = np.sqrt(1 - px * px - py * py)
    shift = along / (1 + height) + z
    return np.stack([x - px * shift, y - py * shift, along + height * z], 1)


def first_positive(multiples):
    """A combination and its negative are one."""
    leading = next((multiple for multiple in multiples if multiple), 0)
    return tuple(-multiple for multiple in multiples) if leading < 0 else tuple(multiples)


def candidates():
    """Combinations of arguments that may be asked for."""
    found = set()
    for main in itertools.product(range(-10, 11), range(-4, 5), range(-9, 10), range(-7, 8)):
        if sum(map(abs, main)) <= 14:
            found.add(main + (0,) * 6)
    pairs = [(0, 0, 0, j, s) for j in range(-4, 5) for s in range(-6, 7) if j and s]
    for planet, largest in ((0, 26), (2, 10), (3, 5), (4, 5)):
        for a, b in itertools.product(range(-largest, largest + 1), range(-30, 31)):
            if a and abs(a + b) <= 3 and abs(a) + abs(b) <= 46:
                pair = [0] * 5
                pair[planet], pair[1] = a, b
                pairs.append(tuple(pair))
    for d, l, f in itertools.product(range(-6, 7), range(-5, 6), range(-3, 4)):
        if abs(d) + abs(l) + abs(f) <= 8:
            found.update((d, 0, l, f) + pair + (0,) for pair in pairs)
    # The Moon's longitude from the equinox is D + Te + p: the figure of the Earth.
    for d, s, l, f in itertools.product(range(-4, 5), range(-1, 2), range(-4, 5), range(-4, 5)):
        if abs(d) + abs(s) + abs(l) + abs(f) <= 7:
            found.update((d + z, s, l, f, 0, z, 0, 0, 0, z) for z in (-2, -1, 1, 2))
    return np.array(sorted({first_positive(c) for c in found} - {NONE}), dtype=np.int8)


class Series:
    def __init__(self, jd, observed):
        self.jd, self.tau, self.observed = jd, scaled(jd), observed
        t = centuries(jd)
        self.arguments = {name: polynomial.polyval(t, np.radians(powers)) for name, powers in ARGUMENTS}
        still = np.polynomial.Polynomial(LONGITUDE) - np.polynomial.Polynomial(PRECESSION)
        self.arguments["L"] = polynomial.polyval(t, np.radians(still.coef))
        self.polynomials = {name: chebyshev.chebfit(self.tau[::500], values[::500], DEGREE)
                            for name, values in self.arguments.items()}
        for name in self.arguments:
            self.arguments[name] = chebyshev.chebval(self.tau, self.polynomials[name])
        self.terms = {"longitude": [], "latitude": [], "distance": [(NONE, 0)]}
        self.values = {quantity: np.zeros((len(terms), 2)) for quantity, terms in self.terms.items()}
        self.values["distance"][0, 1] = observed["distance"].mean()

    def phase(self, multiples, at):
        return sum((m * self.arguments[name][at] for m, (name, _) in zip(multiples, ARGUMENTS) if m),
                   np.zeros(len(self.tau[at])))

    def left(self, quantity, at):
        """Observed less computed, rad."""
        left = self.observed[quantity][at].copy()
        if quantity == "longitude":
            left -= self.arguments["L"][at]
        known = None
        for (multiples, power), (sine, cosine) in zip(self.terms[quantity], self.values[quantity]):
            if multiples != known:
                known, phase = multiples, self.phase(multiples, at)
                sines, cosines = np.sin(phase), np.cos(phase)
            left -= self.tau[at] ** power * (sine * sines + cosine * cosines)
        return np.angle(np.exp(1j * left)) if quantity == "longitude" else left

    def design(self, quantity, at):
        rows, known = [], None
        for multiples, power in self.terms[quantity]:
            if multiples != known:
                known, phase = multiples, self.phase(multiples, at)
                sines, cosines = np.sin(phase), np.cos(phase)
            rows += [self.tau[at] ** power * sines, self.tau[at] ** power * cosines]
        return np.array(rows)

    def fit(self, at, fitted):
        """One step of Gauss and Newton for all coefficients and some of the Moon's own arguments."""
        powers = chebyshev.chebvander(self.tau[at], DEGREE).T
        shared = len(fitted) * len(powers)
        sizes = {quantity: 2 * len(terms) for quantity, terms in self.terms.items()}
        total = sum(sizes.values()) + shared
        matrix, right, begin = np.zeros((total, total)), np.zeros(total), 0
        for quantity, size in sizes.items():
            design, left = self.design(quantity, at), self.left(quantity, at)
            values = self.values[quantity]
            rates = []
            for name in fitted:
                if name == "L":
                    rates.append(np.full(len(left), float(quantity == "longitude")))
                    continue
                column = [name for name, _ in ARGUMENTS].index(name)
                multiples = np.array([m[column] for m, _ in self.terms[quantity]], float)
                weights = np.stack([-multiples * values[:, 1], multiples * values[:, 0]], 1)
                rates.append(weights.ravel() @ design)
            design = np.concatenate([design] + [rate * powers for rate in rates])
            places = np.r_[begin:begin + size, total - shared:total]
            matrix[np.ix_(places, places)] += design @ design.T
            right[places] += design @ left
            begin += size
        scale = np.sqrt(np.diag(matrix)) + 1e-30
        # Damped a little: some terms can hardly be told from a change of the arguments.
        matrix = matrix / scale[:, None] / scale + 1e-8 * np.eye(total)
        step = np.linalg.solve(matrix, right / scale) / scale
        begin = 0
        for quantity, size in sizes.items():
            self.values[quantity] = self.values[quantity] + step[begin:begin + size].reshape(-1, 2)
            begin += size
        for name, change in zip(fitted, step[begin:].reshape(-1, DEGREE + 1)):
            self.polynomials[name] = self.polynomials[name] + change
            self.arguments[name] = chebyshev.chebval(self.tau, self.polynomials[name])

    def search(self, quantity, wanted, combinations, sample, with_powers):
        """Adds terms for the largest lines of what is left."""
        everything = slice(None)
        left = self.left(quantity, everything)
        count, step = len(left), self.jd[1] - self.jd[0]
        middle = count // 2
        speeds = np.array([(self.arguments[name][middle + 500] - self.arguments[name][middle - 500])
                           / (1000 * step * 2 * np.pi) for name, _ in ARGUMENTS])

        def speed_of(multiples):
            """In the spacing of the lines of the spectrum."""
            return np.abs(multiples.astype(float) @ speeds) * count * step

        lines_of_all = speed_of(combinations)
        order = np.argsort(lines_of_all)
        lines_of_all = lines_of_all[order]
        present = np.array(sorted({m for m, _ in self.terms[quantity]} | {NONE}), dtype=np.int8)
        lines = np.abs(np.fft.rfft(left * np.hanning(count))) / (count / 4)
        peaks = 1 + np.flatnonzero((lines[1:-1] > lines[:-2]) & (lines[1:-1] >= lines[2:]))
        peaks = peaks[np.argsort(-lines[peaks])][:4 * wanted]
        tau, left = self.tau[sample], left[sample]
        legendre = [np.ones(len(tau)), np.sqrt(3) * tau, np.sqrt(5) * (1.5 * tau**2 - 0.5)]
        added, taken = 0, []
        for peak in peaks:
            height = lines[peak]
            if added == wanted or height < SMALLEST_ARCSEC * ARCSEC:
                break
            if any(abs(peak - other) < 4 for other in taken):
                continue
            taken.append(peak)
            # A line that a term stands in already asks for its next power of time.
            near = present[np.abs(speed_of(present) - peak) < 0.8]
            if not len(near):
                low, high = np.searchsorted(lines_of_all, [peak - 2, peak + 2])
                near = combinations[order[low:high]]
            burden = np.abs(near.astype(int)).sum(1) + 3 * near[:, 4:9].any(1)
            found = []
            for index in np.argsort(burden, kind="stable")[:12]:
                multiples = tuple(int(m) for m in near[index])
                turning = left * np.exp(-1j * self.phase(multiples, sample))
                followed = [2 * abs(np.mean(turning * weight)) for weight in legendre]
                power = int(np.argmax(followed)) if with_powers else 0
                found.append((followed[power], burden[index], multiples, power))
            best = max((entry[0] for entry in found), default=0)
            if best < 0.3 * height:
                continue
            good = [entry for entry in found if entry[0] > 0.93 * best]
            _, _, multiples, power = min(good, key=lambda entry: entry[1])
            powers = [p for m, p in self.terms[quantity] if m == multiples]
            missing = [p for p in range(power + 1) if p not in powers] or [len(powers)]
            if missing[-1] > (3 if with_powers else 0):
                continue
            for p in missing:
                self.terms[quantity].append((multiples, p))
                self.values[quantity] = np.vstack([self.values[quantity], [0, 0]])
            added += 1
        order = sorted(range(len(self.terms[quantity])), key=lambda i: self.terms[quantity][i])
        self.terms[quantity] = [self.terms[quantity][i] for i in order]
        self.values[quantity] = self.values[quantity][order]
        return added, height / ARCSEC

    def prune(self, smallest):
        """Drops terms whose largest share is small, where no higher power of time needs them."""
        for quantity, terms in self.terms.items():
            highest = {m: max(p for n, p in terms if n == m) for m, _ in terms}
            size = np.hypot(*self.values[quantity].T)
            keep = [i for i, (m, p) in enumerate(terms) if size[i] > smallest or p < highest[m] or m == NONE]
            self.terms[quantity] = [terms[i] for i in keep]
            self.values[quantity] = self.values[quantity][keep]

    def report(self, heading):
        print(heading)
        for quantity in self.terms:
            left = self.left(quantity, slice(None, None, 7)) / ARCSEC
            print(f"  {quantity}: {len(self.terms[quantity])} terms; left over in arcseconds, or 1/206265 of"
                  f" {DISTANCE_KM:.0f} km: rms {left.std():.3f}, largest {np.abs(left).max():.3f}", flush=True)


def powers_of(coefficients):
    return ", ".join(repr(float(value)) for value in chebyshev.cheb2poly(coefficients))


def write(series, pole, folder):
    head = "//! Made by `scripts/de431_moon.py`: do not edit.\n"
    with open(f"{folder}/arguments.rs", "w") as file:
        file.write(head + "//!\n//! Polynomials of scaled time: coefficients of its powers.\n\n")
        file.write(f"/// Centuries from J2000.0 to the time zero of the polynomials.\n"
                   f"pub const MIDDLE_CENTURIES: f64 = {MIDDLE};\n"
                   f"/// Centuries of a unit of their time.\npub const UNIT_CENTURIES: f64 = {HALF};\n\n")
        file.write("/// Mean longitude in the ecliptic of date, from a point that does not turn, rad.\n"
                   f"#[rustfmt::skip]\npub const LONGITUDE: [f64; {DEGREE + 1}] = "
                   f"[{powers_of(series.polynomials['L'])}];\n\n")
        file.write("/// The arguments D, l', l, F, Ve, Te, Ma, Ju, Sa, p, rad.\n"
                   f"#[rustfmt::skip]\npub const ARGUMENTS: [[f64; {DEGREE + 1}]; {len(ARGUMENTS)}] = [\n")
        for name, _ in ARGUMENTS:
            file.write(f"    [{powers_of(series.polynomials[name])}],\n")
        reach = np.abs([m for terms in series.terms.values() for m, _ in terms]).max(0)
        file.write("];\n\n/// The largest multiple of each argument in any term.\n"
                   f"pub const REACH: [usize; {len(ARGUMENTS)}] = {reach.tolist()};\n"
                   "\n/// The pole of the ecliptic of date in ecliptic J2000.0: x, y.\n"
                   f"#[rustfmt::skip]\npub const POLE: [[f64; {POLE_DEGREE + 1}]; 2] = [\n")
        for coordinate in pole.T:
            file.write(f"    [{powers_of(coordinate)}],\n")
        file.write("];\n")
    units = {"longitude": (1e4 / ARCSEC, "1e-4 arcseconds"), "latitude": (1e4 / ARCSEC, "1e-4 arcseconds"),
             "distance": (DISTANCE_KM * 1000, "metres")}
    for quantity, (unit, name) in units.items():
        with open(f"{folder}/{quantity}.rs", "w") as file:
            file.write(head + "\nuse super::Term;\n\n")
            file.write("/// Multiples of D, l', l, F, Ve, Te, Ma, Ju, Sa, p; power of scaled time; sine, cosine,\n"
                       f"/// {name}.\n#[rustfmt::skip]\n"
                       f"pub const TERMS: [Term; {len(series.terms[quantity])}] = [\n")
            for (multiples, power), values in zip(series.terms[quantity], series.values[quantity]):
                sine, cosine = np.rint(values * unit).astype(int)
                file.write(f"    ({list(multiples)}, {power}, {sine}, {cosine}),\n")
            file.write("];\n")


def main(path, folder):
    samples = Samples(path)
    jd = np.arange(2451545.0 - 5001 * 365.25 + 1, 2451545.0 + 1001 * 365.25 - 1, STEP_DAYS)
    pole = pole_of_ecliptic(samples, jd)
    x, y, z = to_ecliptic_of_date(samples.km("moon", jd), pole, jd).T
    distance = np.sqrt(x * x + y * y + z * z)
    series = Series(jd, {"longitude": np.arctan2(y, x), "latitude": np.arcsin(z / distance),
                         "distance": distance / DISTANCE_KM})
    random = np.random.default_rng(431)
    at = np.sort(random.choice(len(jd), FIT_POINTS, replace=False))
    few = np.sort(random.choice(at, FIT_POINTS // 3, replace=False))
    combinations = candidates()
    for number, wanted in enumerate(ROUNDS, 1):
        for quantity, count in zip(series.terms, wanted):
            if count:
                added, height = series.search(quantity, count, combinations, few, number >= FIRST_ROUND_WITH_POWERS)
                print(f"  {quantity}: {added} lines down to {height:.4f} arcseconds", flush=True)
        # The first step finds the coefficients: the arguments' share in the next depends on them.
        series.fit(few, [])
        if number >= FIRST_ROUND_WITH_ARGUMENTS:
            series.fit(few, FITTED)
        series.report(f"Round {number}")
    series.prune(0.004 * ARCSEC)
    for fitted in ([], FITTED):
        series.fit(at, fitted)
    series.report("In the end")
    write(series, pole, folder)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
