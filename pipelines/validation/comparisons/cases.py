"""The scenes of the comparisons: the boxes of Tables 2.1.5.1 and 2.4.1.1, the models of Table 2.4.4.1."""

import math
from dataclasses import dataclass
from pathlib import Path

from ...scene.methods import METHODS
from ...scene.scene import Scene, make_scene, read_scene
from .report_units import travel

SCENES = Path(__file__).parents[2] / "scenes"
BEAM, DRAFT, HEIGHT = 50.0, 10.0, 20.0  # m, of every box of the series
XI = (0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 2.75)  # values of the SR179 report
CLOSE_XI = tuple(sorted({*XI, *(round(0.05 * i, 2) for i in range(2, 56))}))  # close values for curves without corners
CHI = (0, 30, 45, 60, 90)
DEPTH_DRAFT = (1.2, 1.4, 2.0, 5.0, 10.0, math.inf)
LENGTH_BEAM = (1.0, 1.5, 2.0, 4.0, 8.0)
MODELS = {"M3A_Bd10": "model_M3A_d250", "M3A_Bd20": "model_M3A_d125", "M3B_Bd10": "model_M3B_d194"}
MODEL_CHI = (0, 45, 90)
TOLERANCE = {"contour": 1e-3, "panel": 0.01, "strip": 1e-3, "inverse-strip": 1e-3}
WANT = ("added_mass", "radiation_damping", "excitation_force", "rao")


@dataclass(frozen=True)
class Case:
    """A scene, the name of its files, the columns that identify it in a table, and its headings χ in degrees."""

    name: str
    columns: dict
    scene: Scene
    chi: tuple


def series_case(length_beam, depth_draft, method=None, xi=XI):
    """A box of Table 2.1.5.1, uniform and solid up to its deck, its centre of gravity in the waterplane (KG = d).

    method : left out, contour in water of finite depth and panel in deep water
    """
    method = method or ("panel" if math.isinf(depth_draft) else "contour")
    length = length_beam * BEAM
    squares = BEAM**2 + HEIGHT**2, length**2 + HEIGHT**2, length**2 + BEAM**2
    body = {"shape": "box", "length": length, "beam": BEAM, "draft": DRAFT}
    scene = make_scene(
        {
            "method": method,
            "tolerance": TOLERANCE[method],
            "want": list(WANT),
            "water": {"depth": depth_draft * DRAFT},
            "bodies": [{**body, "gyration": [math.sqrt(square / 12) for square in squares]}],
            "waves": waves(xi, CHI),
        }
    )
    columns = {"method": method, "L_over_B": length_beam, "H_over_d": depth_draft, "B_over_d": BEAM / DRAFT}
    return Case(f"LB{length_beam:g}_Hd{depth_draft:g}_{method}", columns, scene, CHI)


def model_case(model, method, xi, wave_height=None):
    """A model of Table 2.4.4.1, rotations about its centre of gravity.

    model : one of `MODELS`; wave_height : m, with the roll damping of Yamashita linearised in it; None for no such
        damping
    """
    raw = read_scene(SCENES / f"{MODELS[model]}.toml")
    raw["method"] = method
    raw["tolerance"] = TOLERANCE[method] if method in ("contour", "strip", "inverse-strip") else raw["tolerance"]
    raw["rotation_center"] = raw["bodies"][0]["center_of_gravity"]
    drifting = "drift_force" not in METHODS[method].without
    raw["want"] = [*WANT, "drift_force"] if drifting else list(WANT)
    raw["waves"] = waves(xi, MODEL_CHI)
    name, columns = f"{model}_{method}", {"model": model, "method": method, "wave_height_m": 0.0}
    if wave_height is not None:
        raw["viscous"] = {"wave_height": wave_height, "roll": "Yamashita"}
        name, columns = f"{name}_{100 * wave_height:g}cm", {**columns, "wave_height_m": wave_height}
    return Case(name, columns, make_scene(raw), MODEL_CHI)


def waves(xi, chi):
    """The table [waves] of a scene; xi : numbers, or the table of a span"""
    listed = xi if isinstance(xi, dict) else [float(x) for x in xi]
    return {"xi_B": listed, "headings_deg": [travel(angle) for angle in chi]}
