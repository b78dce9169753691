"""Spectra as SWAN writes them (.spc, .sp1, .sp2, .s1d, .s2d, .hot): AFREQ or RFREQ, NDIR or CDIR, VaDens or EnDens.

AcDens, used in the restart file, is VaDens over ω.

Files are 1-D, with mean direction and spread, or 2-D, with FACTOR, ZERO, NODATA. Of several quantities in a 2-D file
only the first is used (SWAN user manual, appendix D).  Remarks may follow a number that stands alone in its line.
"""

import numpy as np

from hakobune.meshing.text_files import numbers_of

from ..environment.sea import Sea
from ..environment.spectra import tabulated
from ..environment.spreading import HalfCosinePower
from ..environment.tables import TableError
from .planes import two_dimensional

ENERGY = 1025.0 * 9.81  # J/m³, for EnDens, as in SWAN


class Swan:
    """Lines of a SWAN file, read one after the other"""

    def __init__(self, path, text):
        self.path, self.at = path, 0
        lines = enumerate(text.splitlines(), 1)
        self.lines = [(n, line) for n, line in lines if line.strip() and not line.lstrip().startswith("$")]

    def fault(self, wanted):
        n, line = self.lines[min(self.at, len(self.lines) - 1)]
        return TableError(f"{self.path}: line {n} is {line.strip()[:40]!r}; expected: {wanted}")

    def words(self):
        if self.at >= len(self.lines):
            raise self.fault("more lines, but the file ends")
        self.at += 1
        return self.lines[self.at - 1][1].split()

    def count(self, thing):
        word = self.words()[0]
        if not word.isdecimal() or not 1 <= int(word) <= 100_000:
            self.at -= 1
            raise self.fault(f"the number of {thing}")
        return int(word)

    def numbers(self, count, thing):
        """Numbers from as many lines as needed; shape (count,)

        SWAN writes remarks after a single number, but not among many numbers. There a word is a fault: if it were
        skipped, the next line, which may be a time, would be read in its place.
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
        """The Sea of the requested time and location, from the head of the file and the block of numbers"""
        head, timed, places = {}, False, 1
        while "QUANT" not in head:
            word = self.words()[0].upper()
            if word in ("TIME", "ITER"):
                timed = True
                self.words()
            elif word in ("LOCATIONS", "LONLAT"):
                places = self.count("locations")
                self.at += places
            elif word in ("AFREQ", "RFREQ"):
                head["omega"] = 2 * np.pi * self.rows("frequencies")
            elif word in ("NDIR", "CDIR"):
                if not self.none_follows():
                    head["angle"] = word, self.rows("directions")
            elif word == "QUANT":
                head["QUANT"] = [self.quantity() for _ in range(self.count("quantities"))]
        if "omega" not in head:
            raise TableError(f"{self.path} has no AFREQ or RFREQ; allowed: the frequencies before QUANT")
        if not 1 <= location <= places:
            raise TableError(f"{self.path} has {places} locations, and location is {location}; allowed: 1 to {places}")
        if timed:
            self.to_time(time, head, places)
        for _ in range(location - 1):
            self.block(head)
        return self.made(head, self.block(head), x_axis)

    def none_follows(self):
        """Whether the file states 0 directions and lists none, as a 1-D file does; the line with the 0 is then read"""
        said = [line.split()[0] for _, line in self.lines[self.at : self.at + 2]]
        none = said[:1] == ["0"] and not numbers_of(said[-1])
        self.at += none
        return none

    def rows(self, thing):
        return np.array([self.numbers(1, thing)[0] for _ in range(self.count(thing))])

    def quantity(self):
        name, unit, none = self.words()[0], self.words()[0], self.numbers(1, "an exception value")[0]
        return name.upper(), unit, none

    def to_time(self, time, head, places):
        """Move to the wanted time; by default the file must have a single time"""
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
                        raise TableError(f"{self.path} has several times, the first is {found}; choose one with time")
                self.at = start
                return
            for _ in range(places):
                self.block(head)
        raise TableError(f"{self.path} has no time {time}; it has {', '.join(seen[:6])}")

    def block(self, head):
        """Numbers of one location, shape (n, columns), in a 2-D file of the first quantity; None without data"""
        found = self.part(head)
        for _ in head["QUANT"][1:] if "angle" in head and found is not None else ():
            self.part(head)
        return found

    def part(self, head):
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
            raise TableError(f"{self.path} has no data there (NODATA); choose another location or time")
        names = [name for name, *_ in head["QUANT"]]
        omega, name = head["omega"], self.path.stem
        per = {"VADENS": 1.0, "ENDENS": ENERGY, "ACDENS": 1 / omega[:, None]}.get(names[0])
        if per is None or (names[0] == "ACDENS" and "angle" not in head):
            raise TableError(
                f"{self.path}: the first quantity is {names[0]}; allowed: VaDens, EnDens, or AcDens by direction"
            )
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
        """Sea with the energy-weighted mean direction and spread: cos²ˢ(θ/2) with s = 2/σ² − 1 (Kuik et al. 1988)"""
        there = density > 0
        angle = self.travelled(kind, np.radians(values[there, 1]), x_axis)
        mean = np.angle(density[there] @ np.exp(1j * angle))
        sigma = np.radians(density[there] @ values[there, 2] / density[there].sum())
        return Sea(spectrum, float(mean), HalfCosinePower(max(2 / sigma**2 - 1, 0.0)) if sigma > 1e-3 else None)

    def travelled(self, kind, angle, x_axis):
        """Directions of travel in the body's axes, rad"""
        if kind == "CDIR":
            return angle - np.radians(x_axis or 0.0)
        if x_axis is None:
            raise ValueError("directions are nautical; give the compass heading of the x axis (x_axis_compass_deg)")
        return np.radians(x_axis) - angle - np.pi
