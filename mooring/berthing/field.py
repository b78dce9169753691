"""Fifty measured berthings of very large crude carriers at two sea berths, compared with the kinetic-energy method.

Ueda (1981), tables 2.1, 2.2, 2.3 and 2.5 (`tables/field.csv`).  The tables round speeds down to full cm/s (V ≤ true
< V + 1). This causes most of the scatter of the ratio of absorbed to effective energy. Weights are in tonf, with g =
9.8 m/s² and 1.03 tonf/m³.
"""

from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import packaged_rows

from .energy import Ship, berthing_energy, eccentricity, virtual_mass_older, virtual_mass_ueda

GRAVITY, WATER = 9.8, 1030.0  # m/s², kg/m³, of the tables


class Contact(NamedTuple):
    """A contact as printed: displacement and virtual mass in ktonf, sizes in m, speed in cm/s, energies in tonf m;
    NaN where missing

    doubt : names of values that are inconsistent in print: speed, weight, offset, absorbed, draft
    """

    ship: str
    number: int
    displacement: float
    length: float
    beam: float
    draft: float
    speed: float
    gyration: float
    offset: float
    eccentricity: float
    virtual: float
    effective: float
    absorbed: float
    doubt: tuple

    @property
    def vessel(self):
        """The ship as `energy.Ship`, mass in kg"""
        return Ship(self.length, self.beam, self.draft, 1e6 * self.displacement, self.gyration, WATER)


def contacts():
    """All `Contact` of the table"""
    return [_contact(list(row.values())) for row in packaged_rows(__package__, "field")]


def _contact(row):
    numbers = [float(value) if value else np.nan for value in row[2:13]]
    return Contact(row[0], int(row[1]), *numbers, tuple(row[13].split()))


def effective_energies(contact):
    """{method: energy in tonf m} by the kinetic-energy method with the older virtual mass (as in table 2.5) and with
    Ueda's
    """
    ship, share = contact.vessel, eccentricity(contact.offset, contact.gyration)
    methods = {"older": virtual_mass_older, "Ueda 1981": virtual_mass_ueda}
    found = {key: berthing_energy(ship, contact.speed / 100, of(ship), share) for key, of in methods.items()}
    return {key: value / (1e3 * GRAVITY) for key, value in found.items()}


class Comparison(NamedTuple):
    """contacts : number of contacts; median, low, high : median and quartiles of absorbed over effective energy;
    bounded : fraction of contacts whose absorbed energy lies between the effective energies at V and V + 1 cm/s
    """

    contacts: int
    median: float
    low: float
    high: float
    bounded: float


def compared(method, table=None):
    """`Comparison` of absorbed with effective energy by a method of `effective_energies`, over consistent contacts"""
    good = [c for c in table or contacts() if not c.doubt and np.all(np.isfinite(c[2:10])) and c.absorbed > 0]
    effective = np.array([effective_energies(c)[method] for c in good])
    absorbed, speed = (np.array([getattr(c, key) for c in good]) for key in ("absorbed", "speed"))
    ratio = absorbed / effective
    low, median, high = np.quantile(ratio, [0.25, 0.5, 0.75])
    bounded = np.mean((ratio >= 1) & (ratio <= (1 + 1 / speed) ** 2))
    return Comparison(len(good), float(median), float(low), float(high), float(bounded))
