"""A scene: water, floating bodies, waves and the requested results, as typed TOML.

Flags of the commands and scene files give the same `Scene`; every fault is one line that names key, value and allowed
values.  Angles are in degrees here, as everywhere in this package and nowhere below it.
"""

import math
from functools import cached_property
from pathlib import Path

import numpy as np
from msgspec.structs import replace

from hakobune.bem.viscous_table import ViscousTable
from hakobune.bem.waves import wavenumber

from ..common.typed import of_another, read_toml, typed
from . import products
from .checks import check, check_depth_given
from .methods import chosen_method, names_given
from .tables import (
    FREQUENCY_KEYS,
    SHAPES,
    BodyTable,
    DampingLidTable,
    ModeTable,
    SceneError,
    SceneTable,
    Water,
    Waves,
    listed,
)


class Scene(SceneTable, dict=True):  # dict=True: derived quantities are cached in it
    """One or several floating bodies with their water, their waves and the results that are computed

    want : names or groups of results; by default everything
    tolerance : relative error of the coefficients [0.01]; or give panels
    panels : number of panels on the whole hull; a tolerance beside it is the limit of the checks alone
    method : solution method: auto, panel, contour, transfer, pressure, strip or inverse-strip
    rotation_center : m, x, y, z of the point of rotations and moments
    lid : whether an interior lid removes irregular frequencies
    wall : m, y of a vertical wall along x that reflects all waves
    damping_lids : damping lids on the water between hulls or in moonpools
    modes : shapes in which bodies bend or twist, with the panel method
    """

    water: Water
    bodies: list[BodyTable]
    waves: Waves
    want: list[str] | None = None
    tolerance: float | None = None
    panels: int | None = None
    method: str = "auto"
    rotation_center: tuple[float, float, float] = (0.0, 0.0, 0.0)
    lid: bool = True
    wall: float | None = None
    damping_lids: list[DampingLidTable] | None = None
    modes: list[ModeTable] | None = None
    viscous: ViscousTable | None = None

    @cached_property
    def body(self):
        """The body, or the first of several"""
        return self.bodies[0]

    @cached_property
    def several(self):
        """Whether there are several bodies"""
        return len(self.bodies) > 1

    def alone(self, number):
        """The scene of one of several bodies in its own coordinates"""
        body = self.bodies[number]
        own = replace(body, name=None, place=None, rotation_center=None, fixed=False, viscous=None)
        center = body.rotation_center or (0.0, 0.0, 0.0)
        return replace(self, bodies=[own], rotation_center=center, method="panel", viscous=None, modes=None)

    @property
    def accuracy(self):
        """Requested relative error, `tolerance` or its default."""
        return 0.01 if self.tolerance is None else self.tolerance

    @property
    def dimensions(self):
        """{name: m} by the shape; empty for several bodies"""
        if self.several:
            return {}
        keys = [key for key in SHAPES[self.body.shape] if key not in ("file", "block")]
        return {key: getattr(self.body, key) for key in keys}

    @cached_property
    def held(self):
        """Whether no body moves"""
        return all([body.fixed for body in self.bodies])

    @cached_property
    def motions_known(self):
        """Whether bodies move, and the inertia is given for all moving bodies."""
        return not self.held and all([body.gyration is not None for body in self.bodies if not body.fixed])

    def omegas(self):
        """Frequencies, ascending, rad/s; shape (n,); for a band its ends"""
        return self._omegas

    def headings(self):
        """Headings, ascending, rad; shape (m,)"""
        return np.radians(np.sort(listed("waves.headings_deg", self.waves.headings_deg)))

    def names(self):
        """Wanted names of the database."""
        return names_given(self, products.expand(self.want, self.motions_known, self.held), self.want or ())

    @cached_property
    def solved_by(self):
        """Name of the method that solves the scene, of `pipelines.scene.methods.METHODS`"""
        return chosen_method(self)

    @property
    def shortest_wave(self):
        """m, of the highest frequency"""
        return 2 * math.pi / float(wavenumber(self.omegas()[-1], self.water.depth, self.water.gravity))

    @cached_property
    def _omegas(self):
        key = next(key for key in FREQUENCY_KEYS if getattr(self.waves, key) is not None)
        values = np.array(listed(f"waves.{key}", getattr(self.waves, key)))
        if key == "periods":
            values = 2 * np.pi / values
        elif key == "xi_B":
            values = np.sqrt(2 * self.water.gravity * values / self.beam)
        return np.sort(values)

    @property
    def beam(self):
        """m, or the diameter of a buoy"""
        return self.body.beam if self.body.beam is not None else 2 * self.body.radius


def read_scene(path):
    """The raw tables of a scene file, with mesh file names relative to the current folder.

    Raises SceneError if the file is missing, not TOML, or a file of another command, which is checked before tables
    from the command line are added.
    """
    path = Path(path)
    raw, _ = read_toml(path, "a scene", SceneError)
    other = of_another(raw, Scene)
    if other:
        raise SceneError(other)
    tables = [one for key in ("bodies", "modes") if isinstance(raw.get(key), list) for one in raw[key]]
    for table in tables:
        if isinstance(table, dict) and isinstance(table.get("file"), str):
            table["file"] = str(path.parent / table["file"])
    return raw


def make_scene(raw):
    """A checked Scene of nested dictionaries read from TOML.  Raises SceneError."""
    check_depth_given(raw)
    waves = raw.get("waves")
    if isinstance(waves, dict) and isinstance(waves.get("omegas"), str):  # as the flag has it
        kept = {key: value for key, value in waves.items() if key != "omegas"}
        raw = raw | {"waves": kept | {"band": band("waves.omegas", waves["omegas"])}}
    scene = typed(raw, Scene, SceneError)
    check(scene)
    return scene


def numbers(key, text):
    """`a,b,c` as a list, `start:stop:count` as the table of a span.  Raises SceneError."""
    try:
        if ":" in text:
            first, last, count = text.split(":")
            return {"from": float(first), "to": float(last), "count": int(count)}
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise SceneError(f"{key} is {text!r}; allowed: a,b,c or start:stop:count") from None


def band(key, text):
    """`auto:from:to` as the table of a band.  Raises SceneError."""
    try:
        word, first, last = text.split(":")
        if word == "auto":
            return {"from": float(first), "to": float(last)}
    except ValueError:
        pass
    raise SceneError(f"{key} is {text!r}; allowed: auto:from:to in rad/s, such as auto:0.1:2.0")
