"""Spectra as buoys and hindcast models give them, in one and in two dimensions.

    SWAN standard spectral file (.spc, .sp1, .sp2): AFREQ or RFREQ, NDIR or CDIR, VaDens or EnDens; 1-D with mean
    direction and spread, or 2-D with FACTOR, ZERO, NODATA (SWAN user manual, appendix D)
    NDBC spectral wave density (swden): a head "#YY MM DD hh mm .0200 .0325 …" and rows of m²/Hz, 999 for none;
    of the last days (data_spec): rows "YY MM DD hh mm Sep_Freq spec_1 (freq_1) …"
    WAVEWATCH III transfer file of spectra (`wavewatch`)

Nautical directions are where waves come from, clockwise from north; with the x axis of the body towards ψ of the
compass waves travel to β = ψ − (N + 180°).  Cartesian ones are where they travel to, from the x axis of the model,
which is taken for the body's after it is turned by the heading given.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hakobune.meshing.text_files import numbers_of, read_text

from ..environment.sea import Sea
from ..environment.spectra import tabulated
from ..environment.spreading import HalfCosinePower, Spreading
from ..environment.tables import TableError
from .wavewatch import HEAD, read_wavewatch

MISSING = 999.0
ENERGY = 1025.0 * 9.81  # J/m³, of EnDens, as SWAN has it


@dataclass(frozen=True, eq=False, repr=False)
class TabulatedSpreading(Spreading):
    """Directions of a two-dimensional spectrum: straight between rows of omega (n,) rad/s and of angle (m,) rad.

    values : (n, m) 1/rad, each row of integral one; angle rising over one turn at most, closed at its end
    """

    omega: np.ndarray
    angle: np.ndarray
    values: np.ndarray
    depends_on_frequency = True

    def __repr__(self):
        return f"<spreading of {len(self.omega)} frequencies and {len(self.angle)} directions>"

    def __str__(self):
        return f"spread over directions as {len(self.omega)} × {len(self.angle)} values of a file"

    def density(self, angle, omega=None):
        if omega is None:
            raise ValueError("a spectrum in two dimensions spreads by frequency; give omega")
        angle, omega = np.broadcast_arrays(np.asarray(angle, float), np.asarray(omega, float))
        i, s = _place(self.omega, omega)
        turned = np.mod(angle - self.angle[0], 2 * np.pi) + self.angle[0]
        closed = np.append(self.angle, self.angle[0] + 2 * np.pi)
        values = np.concatenate([self.values, self.values[:, :1]], axis=1)
        j, t = _place(closed, turned)
        low = (1 - t) * values[i, j] + t * values[i, j + 1]
        return (1 - s) * low + s * ((1 - t) * values[i + 1, j] + t * values[i + 1, j + 1])


def read_sea(path, x_axis=None, time=None, location=1):
    """`environment.sea.Sea` of a file of the module; long-crested towards 0 where it has no directions.

    x_axis : degrees of the compass that the x axis heads, needed for nautical directions
    time : as the file has it, by default its only one; location : number of the place in the file
    Raises TableError that names the line.
    """
    path = Path(path)
    text = read_text(path, TableError)
    if text.lstrip().upper().startswith("SWAN"):
        return _Swan(path, text).sea(x_axis, time, location)
    if re.match(r"\s*#?\s*YY", text):
        return _ndbc(path, text, time)
    if text.lstrip().startswith(HEAD):
        found = read_wavewatch(path, text, x_axis, time, location)
        try:
            return two_dimensional(*found, path.stem)
        except ValueError as error:
            raise TableError(f"{path}: {error}") from None
    raise TableError(
        f"{path} is no spectrum of SWAN, NDBC or WAVEWATCH III; allowed: a first line SWAN, #YY MM DD hh mm .0200 …, "
        f"or {HEAD}"
    )


def two_dimensional(omega, angle, density, name):
    """Sea of S(ω, θ) (n, m) m² s/rad², omega (n,) rad/s rising, angle (m,) rad travelled to, in any order."""
    order = np.argsort(np.mod(angle, 2 * np.pi))
    angle, density = np.mod(angle, 2 * np.pi)[order], np.asarray(density, float)[:, order]
    if len(angle) < 3 or np.diff(angle).min(initial=1.0) < 1e-6:
        raise ValueError(f"{name}: {len(angle)} directions; allowed: at least 3, each once")
    gaps = np.diff(angle, append=angle[0] + 2 * np.pi)
    if np.count_nonzero(gaps > 1.5 * np.median(gaps)):  # a sector: nothing travels beyond it
        k = int(np.argmax(gaps))
        ends = angle[k] + 1e-4, angle[(k + 1) % len(angle)] - 1e-4 + 2 * np.pi * (k == len(angle) - 1)
        angle = np.mod(np.concatenate([angle, ends]), 2 * np.pi)
        density = np.concatenate([density, np.zeros((len(density), 2))], axis=1)
        order = np.argsort(angle)
        angle, density = angle[order], density[:, order]
        gaps = np.diff(angle, append=angle[0] + 2 * np.pi)
    weight = 0.5 * (gaps + np.roll(gaps, 1))  # of straight lines between rows
    total = density @ weight
    even = np.where(total[:, None] > 0, density / np.maximum(total, 1e-300)[:, None], 1 / (2 * np.pi))
    return Sea(tabulated(omega, total, name), 0.0, TabulatedSpreading(np.asarray(omega, float), angle, even))


class _Swan:
    """Lines of a SWAN file, read one after the other"""

    def __init__(self, path, text):
        self.path, self.at = path, 0
        lines = enumerate(text.splitlines(), 1)
        self.lines = [(n, line) for n, line in lines if line.strip() and not line.lstrip().startswith("$")]

    def fault(self, wanted):
        n, line = self.lines[min(self.at, len(self.lines) - 1)]
        return TableError(f"{self.path}: line {n} is {line.strip()[:40]!r}; wanted: {wanted}")

    def words(self):
        if self.at >= len(self.lines):
            raise self.fault("more lines, the file ends")
        self.at += 1
        return self.lines[self.at - 1][1].split()

    def count(self, thing):
        word = self.words()[0]
        if not word.isdecimal() or not 1 <= int(word) <= 100_000:
            self.at -= 1
            raise self.fault(f"the number of {thing}")
        return int(word)

    def numbers(self, count, thing):
        """(count,) numbers from as many lines as they take

        SWAN writes remarks behind a single number, none among many: there a word is a fault, or the line after it,
        which may be a time, would be taken for what it stands in the place of.
        """
        found = []
        while len(found) < count:
            words = self.words()
            row = numbers_of(" ".join(words))
            if not row or (count > 1 and len(row) < len(words)):
                self.at -= 1
                raise self.fault(f"numbers, {thing}")
            found += row
        return np.array(found[:count])

    def sea(self, x_axis, time, location):
        """The head, then the block of the time and location"""
        head, timed, places = {}, False, 1
        while "QUANT" not in head:
            word = self.words()[0].upper()
            if word == "TIME":
                timed = True
                self.words()
            elif word in ("LOCATIONS", "LONLAT"):
                places = self.count("locations")
                self.at += places
            elif word in ("AFREQ", "RFREQ"):
                head["omega"] = 2 * np.pi * self.rows("frequencies")
            elif word in ("NDIR", "CDIR"):
                head["angle"] = word, self.rows("directions")
            elif word == "QUANT":
                head["QUANT"] = [self.quantity() for _ in range(self.count("quantities"))]
        if "omega" not in head:
            raise TableError(f"{self.path} has no AFREQ or RFREQ; allowed: the frequencies before QUANT")
        if not 1 <= location <= places:
            raise TableError(f"{self.path} has {places} locations, wanted is {location}; allowed: 1 to {places}")
        if timed:
            self.to_time(time, head, places)
        for _ in range(location - 1):
            self.block(head)
        return self.made(head, self.block(head), x_axis)

    def rows(self, thing):
        return np.array([self.numbers(1, thing)[0] for _ in range(self.count(thing))])

    def quantity(self):
        name, unit, none = self.words()[0], self.words()[0], self.numbers(1, "an exception value")[0]
        return name.upper(), unit, none

    def to_time(self, time, head, places):
        """Go to the wanted time; the only one where none is said"""
        seen = []
        while self.at < len(self.lines):
            found = self.words()[0]
            seen.append(found)
            if time is None or str(time) == found:
                start = self.at
                if time is None:
                    for _ in range(places):
                        self.block(head)
                    if self.at < len(self.lines):
                        raise TableError(f"{self.path} has several times, the first is {found}; say which with time")
                self.at = start
                return
            for _ in range(places):
                self.block(head)
        raise TableError(f"{self.path} has no time {time}; it has {', '.join(seen[:6])}")

    def block(self, head):
        """(n, columns) numbers of one location, None where there are none"""
        word = self.words()[0].upper()
        n, m = len(head["omega"]), len(head["angle"][1]) if "angle" in head else len(head["QUANT"])
        if word == "NODATA":
            return None
        if word == "ZERO":
            return np.zeros((n, m))
        if word == "FACTOR":
            return self.numbers(1, "a factor")[0] * self.numbers(n * m, "densities").reshape(n, m)
        if word == "LOCATION":
            return self.numbers(n * m, "densities").reshape(n, m)
        self.at -= 1
        raise self.fault("FACTOR, ZERO, NODATA or LOCATION")

    def made(self, head, values, x_axis):
        if values is None:
            raise TableError(f"{self.path} has no data there (NODATA); take another location or time")
        names = [name for name, *_ in head["QUANT"]]
        if names[0] not in ("VADENS", "ENDENS"):
            raise TableError(f"{self.path} begins with {names[0]}; allowed: VaDens, EnDens")
        per = ENERGY if names[0] == "ENDENS" else 1.0
        omega, name = head["omega"], self.path.stem
        try:
            if "angle" in head:
                kind, degrees = head["angle"]
                angle = self.travelled(kind, np.radians(degrees), x_axis)
                return two_dimensional(omega, angle, values * np.degrees(1) / (2 * np.pi * per), name)
            none = head["QUANT"][0][2]
            density = np.where(values[:, 0] == none, 0.0, values[:, 0]) / (2 * np.pi * per)
            spectrum = tabulated(omega, density, name)
            if len(names) < 3 or names[1] not in ("NDIR", "CDIR"):
                return Sea(spectrum)
            return self.with_mean_direction(spectrum, names[1], density, values, x_axis)
        except ValueError as error:
            raise TableError(f"{self.path}: {error}") from None

    def with_mean_direction(self, spectrum, kind, density, values, x_axis):
        """Mean direction and spread weighed by energy: cos²ˢ(θ/2) with s = 2/σ² − 1 (Kuik et al. 1988)"""
        there = density > 0
        angle = self.travelled(kind, np.radians(values[there, 1]), x_axis)
        mean = np.angle(density[there] @ np.exp(1j * angle))
        sigma = np.radians(density[there] @ values[there, 2] / density[there].sum())
        return Sea(spectrum, float(mean), HalfCosinePower(max(2 / sigma**2 - 1, 0.0)) if sigma > 1e-3 else None)

    def travelled(self, kind, angle, x_axis):
        """rad travelled to in the body's axes"""
        if kind == "CDIR":
            return angle - np.radians(x_axis or 0.0)
        if x_axis is None:
            raise ValueError("directions are nautical; say what the x axis heads by the compass (x_axis_compass_deg)")
        return np.radians(x_axis) - angle - np.pi


def _ndbc(path, text, time):
    """Sea of the row of `time` ("YYYY MM DD hh mm") of a file of densities, or of its only row"""
    lines = [line.split() for line in text.splitlines() if line.strip()]
    if "(" in "".join(lines[-1]):
        return _ndbc_of_last_days(path, text, time)
    head = [word for word in lines[0] if re.fullmatch(r"\d*\.\d+", word)]
    first = len([word for word in lines[0] if word != "#"]) - len(head)
    rows = [row for row in lines[1:] if not row[0].startswith("#")]
    if time is not None:
        rows = [row for row in rows if row[:first] == str(time).split()]
    _check_one(path, rows, time)
    try:
        density = np.array([float(word) for word in rows[0][first:]])
        if len(density) != len(head) or len(head) < 3:
            raise ValueError(f"{len(head)} frequencies and {len(density)} densities; allowed: as many, at least 3")
        density = np.where(density >= MISSING, 0.0, density)
        return Sea(tabulated(2 * np.pi * np.array([float(w) for w in head]), density / (2 * np.pi), path.stem))
    except ValueError as error:
        raise TableError(f"{path}: {error}") from None


def _check_one(path, rows, time):
    if len(rows) != 1:
        state = f"{len(rows)} rows" if time is None else f"{len(rows)} rows of time {time}"
        raise TableError(f"{path} has {state}; allowed: one; say which with time = 'YYYY MM DD hh mm'")


def _ndbc_of_last_days(path, text, time):
    """Sea of one row of pairs m²/Hz (Hz), after the time and the frequency that separates swell from wind sea"""
    rows = [line.split() for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    rows = [row for row in rows if time is None or row[:5] == str(time).split()]
    _check_one(path, rows, time)
    pairs = re.findall(r"([-+.\deE]+)\s*\(\s*([-+.\deE]+)\s*\)", " ".join(rows[0][5:]))
    try:
        density, frequency = np.array(pairs, float).reshape(-1, 2).T
        density = np.where(density >= MISSING, 0.0, density)
        return Sea(tabulated(2 * np.pi * frequency, density / (2 * np.pi), path.stem))
    except ValueError as error:
        raise TableError(f"{path}: {error}") from None


def _place(rows, values):
    """Place below (…,) and share of the way to the next, held at both ends"""
    i = np.clip(np.searchsorted(rows, values, side="right") - 1, 0, len(rows) - 2)
    return i, np.clip((values - rows[i]) / (rows[i + 1] - rows[i]), 0.0, 1.0)
