"""A campaign: each scene is solved and tested against the laws, a row for each; a failure is a result of its row."""

import time
from typing import NamedTuple

import numpy as np

from ...scene.scene import SceneError, make_scene
from .laws import CURVATURE, allowed, kink, violations
from .rotated import rotated
from .scenes import drawn
from .solved import solved

STEP = 1e-3  # step of every parameter, and in radians of the phase of the waves over the hull


class Row(NamedTuple):
    """One scene: its parameters, method of solution, violations of laws over the allowed violations, and the failure.

    waves : number of wave lengths over the body; estimate : stored relative error
    smooth, turned (a rotated and shifted mesh) : NaN where not tried
    verdict : "" or what failed, in a line
    """

    number: int
    shape: str
    width_to_draft: float
    length_to_beam: float
    depth_to_draft: float
    kh: float
    waves: float
    method: str = ""
    panels: int = 0
    seconds: float = 0.0
    estimate: float = np.nan
    reciprocity: float = np.nan
    Haskind: float = np.nan
    energy: float = np.nan
    dissipation: float = np.nan
    smooth: float = np.nan
    turned: float = np.nan
    verdict: str = ""
    command: str = ""

    @property
    def worst(self):
        """Return (violation, law) of the largest; NaN where nothing was solved"""
        found = {name: getattr(self, name) for name in LAWS if getattr(self, name) >= 0}
        return max(((value, name) for name, value in found.items()), default=(np.nan, ""))


LAWS = ("reciprocity", "Haskind", "energy", "dissipation", "smooth", "turned")


def row_of(seed, number, method="auto", tolerance=0.01, most_waves=np.inf, every=20):
    """The `Row` of one scene. The scene is not solved if more than `most_waves` waves lie over the body, or if the
    method cannot represent it.

    every : one scene in `every` is solved again with each parameter perturbed, and one rotated and shifted
    """
    scene = drawn(seed, number)
    start, row = time.perf_counter(), _placed(scene)._replace(command=scene.command(method, tolerance))
    if row.waves > most_waves or not represented(scene, method, tolerance):
        return row
    try:
        row = _solved(scene, row, seed, method, tolerance, every)
        value, law = row.worst
        if value > 1:
            row = row._replace(verdict=f"{law} is {value:.3g} times what an error of {row.estimate:.1e} allows")
    except ValueError as error:
        row = row._replace(verdict=f"refused: {' '.join(str(error).split())}")
    except Exception as error:  # a scene that breaks the solver is what is looked for
        row = row._replace(verdict=f"{type(error).__name__}: {' '.join(str(error).split())}")
    return row if row.seconds else row._replace(seconds=time.perf_counter() - start)


def represented(scene, method, tolerance):
    """Whether a method can represent the scene; `auto` must"""
    try:
        make_scene(scene.tables(method, tolerance))
    except SceneError:
        return method == "auto"
    return True


def _placed(scene):
    """The row of a scene before it is solved"""
    box = scene.shape == "box"
    width = scene.sizes["beam" if box else "radius"]
    return Row(
        scene.number,
        scene.shape,
        width / scene.draft,
        scene.sizes["length"] / width if box else 1.0,
        scene.depth / scene.draft,
        scene.k * scene.depth,
        scene.k * (max(scene.sizes.values()) if box else 2 * width) / (2 * np.pi),
    )


def _solved(scene, row, seed, method, tolerance, every):
    start = time.perf_counter()
    here = solved(scene, method, tolerance)
    row = row._replace(method=here.method, panels=here.panels, seconds=time.perf_counter() - start)
    row = row._replace(estimate=here.estimate, **violations(here))
    if scene.number % every == 0:
        row = row._replace(smooth=roughest(scene, here, method, tolerance))
    if scene.number % every == every // 2:
        row = row._replace(turned=rotated(scene, seed))
    return row


def roughest(scene, here, method, tolerance):
    """Largest second difference over any parameter, over the difference that the errors of the three results allow"""
    found = []
    for _, sides in scene.neighbours(STEP / (1 + scene.k * scene.reach)):
        before, after = (solved(side, method, tolerance) for side in sides)
        errors = allowed(before.estimate) + 2 * allowed(here.estimate) + allowed(after.estimate)
        found.append(kink(before, here, after) / (errors + CURVATURE * STEP**2))
    return max(found)
