"""The table [viscous] of a scene: damping of heave, roll and pitch that depends on the amplitude of the motion.

    [viscous] wave_height = 2.0 # height of the waves in which damping is linearised, m
    roll = "Yamashita"                                       # boxes in deep water, B/d from 5 to 10
    heave = { amplitudes = [0.5, 1.0], b = [0.02, 0.05] }    # b_H of SR179 report (1982), eq. 2.1.4.6
    pitch = { drag = 1.0e9 }                                 # moment over the square of the angular velocity, N m s²

Roll and pitch use the key amplitudes_deg instead of amplitudes.  With several bodies [viscous] has only the wave
height, and
each body has its laws in [bodies.viscous].
"""

import math
import tomllib

import msgspec
import numpy as np

from . import DOFS
from .viscous import Quadratic, Tabulated, Viscous, report_scale, yamashita_roll

MODES = ("heave", "roll", "pitch")


class Law(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    """Viscous damping of one motion: drag, or b at amplitudes

    drag : drag over the square of the velocity, N s²/m² in heave, N m s² in roll and pitch
    b : damping coefficient b of the SR179 report (1982), eq. 2.1.4.6, at each amplitude
    amplitudes : m, rising amplitudes of heave
    amplitudes_deg : degrees, rising amplitudes of roll or pitch
    """

    drag: float | None = None
    b: list[float] | None = None
    amplitudes: list[float] | None = None
    amplitudes_deg: list[float] | None = None


class Laws(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    """Viscous damping of one or several motions

    heave : law of the damping of heave
    roll : law of the damping of roll, or "Yamashita" for boxes in deep water with B/d from 5 to 10
    pitch : law of the damping of pitch
    """

    heave: Law | None = None
    roll: Law | str | None = None
    pitch: Law | None = None


class ViscousTable(Laws, frozen=True, kw_only=True):
    """Damping of heave, roll and pitch that grows with the motion

    wave_height : m, height of the regular waves in which the damping is linearised
    """

    wave_height: float


def viscous_of_text(scene, box, density, gravity):
    """`bem.viscous.Viscous` from the text of a scene with the table [viscous].

    box : {"length", "beam", "draft"} m; empty for a body that is no box, and for several bodies
    Raises ValueError, with a message of one line.
    """
    tables = tomllib.loads(scene)
    table, bodies = msgspec.convert(tables["viscous"], ViscousTable), tables.get("bodies", ())
    if len(bodies) < 2:
        return viscous_of_table(table, box, density, gravity)
    moving = [body for body in bodies if not body.get("fixed")]
    laws = [msgspec.convert(body.get("viscous"), Laws | None) for body in moving]
    rows = [(body["name"], law, box_of(body)) for body, law in zip(moving, laws, strict=True)]
    return viscous_of_several(table, rows, density, gravity)


def box_of(body):
    """{"length", "beam", "draft"}, m, from the table of a body; empty for a body that is no box"""
    return {key: body[key] for key in ("length", "beam", "draft")} if body.get("shape", "box") == "box" else {}


def viscous_of_several(table, bodies, density, gravity):
    """`bem.viscous.Viscous` of several moving bodies.  Raises ValueError.

    bodies : (name, `Laws` or None, box) of each body; box : as in `viscous_of_text`"""
    laws = {}
    for name, own, box in bodies:
        found = {} if own is None else laws_of(f"viscous of {name}", own, box, density, gravity)
        laws |= {f"{name}__{dof}": law for dof, law in found.items()}
    if not laws:
        raise ValueError(
            "viscous has a wave height, but no body has a damping law; give [bodies.viscous] for one body, or leave "
            "out the wave height"
        )
    names = tuple(f"{name}__{dof}" for name, _, _ in bodies for dof in DOFS)
    return Viscous(laws, 0.5 * table.wave_height, names)


def viscous_of_table(table, box, density, gravity):
    """`bem.viscous.Viscous` from a `ViscousTable`; other arguments as in `viscous_of_text`"""
    return Viscous(laws_of("viscous", table, box, density, gravity), 0.5 * table.wave_height)


def laws_of(where, table, box, density, gravity):
    """{degree of freedom: law} of a table of `Laws`.

    where : name of the table, for messages; box : {"length", "beam", "draft"} m; empty for a body that is no box
    Raises ValueError, with a message of one line.
    """
    given = {mode: getattr(table, mode) for mode in MODES if getattr(table, mode) is not None}
    if not given:
        raise ValueError(f"{where} has no damping law; give one for heave, roll or pitch")
    return {mode.capitalize(): _law(f"{where}.{mode}", mode, law, box, density, gravity) for mode, law in given.items()}


def _law(where, mode, law, box, density, gravity):
    if isinstance(law, str):
        if law != "Yamashita":
            raise ValueError(f"{where} is {law!r}; allowed: Yamashita, or a table of drag or b")
        return yamashita_roll(*_sizes(where, box), density)
    if (law.drag is None) == (law.b is None):
        raise ValueError(f"{where}: give one of drag, b")
    if law.drag is not None:
        if not 0 <= law.drag < math.inf:
            raise ValueError(f"{where}.drag is {law.drag:g}; allowed: at least 0, finite")
        return Quadratic(law.drag)
    wanted, other = ("amplitudes", "amplitudes_deg") if mode == "heave" else ("amplitudes_deg", "amplitudes")
    amplitudes = getattr(law, wanted)
    if amplitudes is None or getattr(law, other) is not None:
        raise ValueError(f"{where}.b must have {wanted} and nothing else")
    amplitudes = np.radians(amplitudes) if mode != "heave" else amplitudes
    scale = report_scale(mode.capitalize(), *_sizes(where, box), density, gravity)
    return Tabulated(scale, tuple(amplitudes), tuple(law.b))


def _sizes(where, box):
    if not box:
        raise ValueError(
            f"{where}: b needs the length, beam and draft of a box; give drag instead: drag = 2.36 ζ M/a damps "
            "the amplitude a (m or rad) with the fraction ζ of critical damping, where M is mass and added "
            "mass in kg or kg m²"
        )
    return box["length"], box["beam"], box["draft"]
