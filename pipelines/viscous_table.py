"""The table [viscous] of a scene: damping of heave, roll and pitch that depends on their amplitude.

    [viscous]
    wave_height = 2.0                                        # m, of the regular waves it is linearised in
    roll = "Yamashita"                                       # boxes in deep water, B/d from 5 to 10
    heave = { amplitudes = [0.5, 1.0], b = [0.02, 0.05] }    # b_H of SR179 report (1982), eq. 2.1.4.6
    pitch = { drag = 1.0e9 }                                 # N m s², moment over the square of the velocity

Roll and pitch have amplitudes_deg in place of amplitudes.
"""

from __future__ import annotations

import math

import msgspec
import numpy as np

from bem.viscous import Quadratic, Tabulated, Viscous, report_scale, yamashita_roll

MODES = ("heave", "roll", "pitch")


class Law(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    """drag : N s²/m² or N m s²; or b at amplitudes : m, amplitudes_deg : degrees"""

    drag: float | None = None
    b: list[float] | None = None
    amplitudes: list[float] | None = None
    amplitudes_deg: list[float] | None = None


class ViscousTable(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    """wave_height : m, of the regular waves in which the damping is linearised"""

    wave_height: float
    heave: Law | None = None
    roll: Law | str | None = None
    pitch: Law | None = None


def viscous_of(scene):
    """`bem.viscous.Viscous` of a scene, None if it has none.  Raises ValueError, one line."""
    table = scene.viscous
    if table is None:
        return None
    if not 0 < table.wave_height < math.inf:
        raise ValueError(f"viscous.wave_height is {table.wave_height:g} m; allowed: above 0, finite")
    if not scene.motions_known:
        raise ValueError("viscous damping needs motions; give gyration (--gyration)")
    given = {mode: getattr(table, mode) for mode in MODES if getattr(table, mode) is not None}
    if not given:
        raise ValueError("viscous has no law; give heave, roll or pitch")
    laws = {mode.capitalize(): _law(scene, mode, law) for mode, law in given.items()}
    return Viscous(laws, 0.5 * table.wave_height)


def _law(scene, mode, law):
    if isinstance(law, str):
        if law != "Yamashita":
            raise ValueError(f"viscous.{mode} is {law!r}; allowed: Yamashita, or a table of drag or b")
        return yamashita_roll(*_box(scene, mode), scene.water.density)
    if (law.drag is None) == (law.b is None):
        raise ValueError(f"viscous.{mode}: give one of drag, b")
    if law.drag is not None:
        if not 0 <= law.drag < math.inf:
            raise ValueError(f"viscous.{mode}.drag is {law.drag:g}; allowed: at least 0, finite")
        return Quadratic(law.drag)
    wanted, other = ("amplitudes", "amplitudes_deg") if mode == "heave" else ("amplitudes_deg", "amplitudes")
    amplitudes = getattr(law, wanted)
    if amplitudes is None or getattr(law, other) is not None:
        raise ValueError(f"viscous.{mode}.b needs {wanted}, and nothing else")
    amplitudes = np.radians(amplitudes) if mode != "heave" else amplitudes
    scale = report_scale(mode.capitalize(), *_box(scene, mode), scene.water.density, scene.water.gravity)
    return Tabulated(scale, tuple(amplitudes), tuple(law.b))


def _box(scene, mode):
    if scene.body.shape != "box":
        raise ValueError(f"viscous.{mode}: b is made dimensionless by length, beam and draft; give drag")
    return scene.body.length, scene.body.beam, scene.body.draft
