"""The kinetic-energy method: the energy of a berthing ship that a fender must absorb.

    E = ½ C_M M V² C_e C_s C_c

M mass of the ship, V speed of approach across the berth.  C_M virtual mass (entrained water), C_e eccentricity (energy
kept by rotation), C_s softness (energy absorbed by the hull), C_c configuration (cushion of water).

Ueda (1981), Report of the Port and Harbour Research Institute 20(2): eq. 2.8, 2.22, 3.4 to 3.7, with L length over all;
PIANC (2002), Guidelines for the design of fender systems, as publicly quoted.
"""

import math
from typing import NamedTuple

LEAST_GAP = 0.1  # water under the keel over the draft, where PIANC's virtual mass ends to grow
LEAST_BLOCK = 0.1  # far below any hull: a displacement in another unit than t


class BerthingError(ValueError):
    """A berthing cannot be computed; the message names the fault and the limit."""


class Ship(NamedTuple):
    """length over all, beam, draft : m; mass : kg; gyration : radius of gyration in yaw, m; density : density of the
    water, kg/m³
    """

    length: float
    beam: float
    draft: float
    mass: float
    gyration: float
    density: float = 1025.0

    @property
    def block(self):
        """Block coefficient C_B, with the length over all"""
        return self.mass / (self.density * self.length * self.beam * self.draft)


def ship(length, beam, draft, *, mass=None, block=None, gyration=None, density=1025.0):
    """`Ship` of mass or block coefficient; gyration by default length/4.  Raises BerthingError."""
    sizes = {"length": length, "beam": beam, "draft": draft, "density": density}
    sizes |= {key: value for key, value in (("mass", mass), ("gyration", gyration)) if value is not None}
    for key, value in sizes.items():
        if not 0 < value < math.inf:
            raise BerthingError(f"the ship's {key} is {value:g}; allowed: above 0, finite")
    if (mass is None) == (block is None):
        state = "neither is given" if mass is None else "both are given"
        raise BerthingError(f"displacement and block coefficient of the ship: {state}; give one of them")
    made = Ship(length, beam, draft, mass or block * density * length * beam * draft, gyration or length / 4, density)
    if not LEAST_BLOCK <= made.block <= 1.0:
        of = f"{made.block:.3g}, of {made.mass / 1e3:.6g} t"
        raise BerthingError(f"the ship's block coefficient is {of}; allowed: {LEAST_BLOCK:g} to 1")
    return made


def virtual_mass_ueda(ship):
    """C_M = 1 + (π/2)(ρ d² L)/M = 1 + (π/2 C_B) d/B: twice the semicircle of radius d (eq. 3.4, 3.5)"""
    return 1 + math.pi / 2 * ship.density * ship.draft**2 * ship.length / ship.mass


def virtual_mass_older(ship):
    """C_M = 1 + (π/4)(ρ d² L)/M (eq. 2.22)"""
    return 1 + math.pi / 4 * ship.density * ship.draft**2 * ship.length / ship.mass


def virtual_mass_vasco_costa(ship):
    """C_M = 1 + 2 d/B (eq. 3.7)"""
    return 1 + 2 * ship.draft / ship.beam


def virtual_mass_pianc(ship, depth):
    """C_M = 1.8 for an under-keel clearance up to 0.1 d, 1.5 from 0.5 d on, linear in between (PIANC 2002)"""
    gap = (depth - ship.draft) / ship.draft
    return 1.8 - 0.3 * min(1.0, max(0.0, (gap - 0.1) / 0.4))


def virtual_masses(ship, depth=None):
    """{method: C_M}; includes PIANC's if the depth, m, is given. Raises BerthingError if the ship is aground."""
    if depth is not None and not depth > ship.draft:
        raise BerthingError(
            f"the depth is {depth:g} m with a draft of {ship.draft:g} m; allowed: a depth above the draft"
        )
    found = {"Ueda 1981": virtual_mass_ueda(ship), "Vasco Costa": virtual_mass_vasco_costa(ship)}
    found["older, (π/4) ρ d² L"] = virtual_mass_older(ship)
    return found if depth is None else found | {"PIANC 2002": virtual_mass_pianc(ship, depth)}


def shallow(ship, depth):
    """A finding on a ship whose under-keel clearance is smaller than any with known virtual mass; depth : m, or
    None
    """
    gap = None if depth is None else depth - ship.draft
    if gap is not None and gap < LEAST_GAP * ship.draft:
        yield (
            f"the water under the keel is {gap:.3g} m, {100 * gap / ship.draft:.2g} % of the draft; limit "
            f"{100 * LEAST_GAP:g} %: below this limit no method gives a virtual mass, and PIANC's value stays "
            "at 1.8; give approach.virtual_mass from tests, or berth at a higher tide"
        )


def eccentricity(offset, gyration):
    """C_e = 1/(1 + (l/r)²), with l the distance, m, along the berth from the centre of gravity to the contact (eq.
    2.8)
    """
    return 1 / (1 + (offset / gyration) ** 2)


def offset_of(coefficient, gyration):
    """Distance l, m, that gives an eccentricity coefficient"""
    if not 0 < coefficient <= 1:
        raise BerthingError(f"the eccentricity coefficient is {coefficient:g}; allowed: above 0, at most 1")
    return gyration * math.sqrt(1 / coefficient - 1)


def berthing_energy(ship, speed, virtual_mass, eccentricity, softness=1.0, configuration=1.0):
    """Berthing energy, J, by the module's equation; speed : m/s.  Raises BerthingError."""
    if not 0 < speed < math.inf:
        raise BerthingError(f"the speed of the berthing is {speed:g} m/s; allowed: above 0, finite")
    for key, value in (("eccentricity", eccentricity), ("softness", softness), ("configuration", configuration)):
        if not 0 < value <= 1:
            raise BerthingError(f"the coefficient of {key} is {value:g}; allowed: above 0, at most 1")
    if not virtual_mass >= 1:
        raise BerthingError(f"the coefficient of virtual mass is {virtual_mass:g}; allowed: at least 1")
    return 0.5 * virtual_mass * ship.mass * speed**2 * eccentricity * softness * configuration
