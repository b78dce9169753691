"""Large problems: shared work of frequencies, the cost of this work, and whether it fits into memory."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from hakobune.bem.database.schema import ESTIMATES, QUANTITIES
from hakobune.bem.kernels.progress import FINER
from hakobune.bem.methods.panel_problem import WORTH_COMPRESSING, PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.methods.shape_run import RESOLVED
from hakobune.bem.modes import moving, names_of
from hakobune.bem.waves import wavenumber

from ..common.bounds import WORTH_TELLING, check_memory, check_seconds, told
from ..common.progress import duration
from ..scene.scene import SceneError

PER_PANEL = 4  # nodes
# least number of frequencies times classes times nodes^1.5 of a symmetric part at which preparing a band pays: on 576
# and 944 nodes of four classes, 1480 of two, 3136 of one it takes the time that 22, 12, 13, 18 single ones take more
WORTH_SHARING = 2e6
# most nodes for each frequency of a shared preparation: single frequencies are compressed from WORTH_COMPRESSING on
# (`bem.panels.compressed`), and the preparation takes as long as 6 of them on 2 200 nodes, 8 on 3 900
NODES_PER_FREQUENCY = 450
MOST_SHARED = 10_000  # nodes: factors of 3.5 GB; on more every frequency is compressed
FEWEST = 400  # nodes; with fewer a frequency takes less than 0.1 s anyway
# least number of frequencies on an axisymmetric body (`bem.panels.axisymmetric`): the preparation takes as long as 115
# frequencies of 1 000 or 4 000 panels, with two threads 190 and 145
WORTH_SHARING_AXISYMMETRIC = 150
ADAPTIVE = 27  # frequencies that an adaptive band takes, about
NODES_WORTH_TELLING = 6000  # times the root of the classes: a frequency takes two seconds
NODES_WORTH_ASKING = 1500  # a frequency on them takes two seconds, of which asking how long is a tenth
COPIES = 3  # copies of a database in memory while it is created: numbers, file, and the written image


def shared_band(scene, mesh, lid=None, some=None):
    """Return (low, high), rad/s, of frequencies that share their work (`bem.panels.band.equations`), or None

    some : (n,) rad/s, ascending, if not all of the scene
    """
    omegas, nodes = scene.omegas() if some is None else some, PER_PANEL * len(mesh)
    count = len(omegas) if scene.waves.band is None or some is not None else ADAPTIVE
    if nodes < FEWEST or count * _size(mesh) ** 2 <= WORTH_SHARING * nodes**0.5 or nodes > MOST_SHARED:
        return None
    if _size(mesh) > WORTH_COMPRESSING and count < nodes / NODES_PER_FREQUENCY:
        return None
    alone = PanelProblem(mesh, lid, depth=scene.water.depth, wall=scene.wall).prepared()
    if count < WORTH_SHARING_AXISYMMETRIC and alone.axisymmetric_geometry.sectors:
        return None
    return float(omegas.min()), float(omegas.max())


def _size(mesh):
    """Nodes of a symmetric part times the root of its symmetry classes, which take a frequency's time together"""
    return PER_PANEL * len(mesh) * 2 ** (len(mesh.symmetry) / 2)


def announced(problem, limits, console, processes=1, omegas=()):
    """`bem.panels.band.cost.Cost` of a large problem, printed beforehand; None for others, and without a band.

    limits : number of limits of the frequency still to be computed; processes : that each prepare the body
    omegas : (n,) rad/s, of the run
    Raises SceneError if memory or time do not suffice.
    """
    if isinstance(problem, ShapeProblem) and problem.method in RESOLVED and len(omegas):
        _announce_contour(problem, omegas, console, processes)
    panels = problem.panels if isinstance(problem, ShapeProblem) else problem
    if not isinstance(panels, PanelProblem) or _size(panels.mesh) < NODES_WORTH_TELLING:
        return None
    from hakobune.bem.panels.band.cost import cost, memory_alone

    prepared = panels.prepared()
    needed = cost(prepared.geometry, panels.band, panels.gravity) if panels.band else None
    memory = processes * (needed.memory if needed else memory_alone(prepared))
    _check_memory(panels.mesh.total, memory, processes)
    if console:
        text = f"{panels.mesh.total} panels: about {memory / 1e9:.1f} GB"
        times = _times(needed, limits) if needed else _time_alone(prepared, omegas)
        console.print(text + times, highlight=False, soft_wrap=True)
    return needed


def _announce_contour(problem, omegas, console, processes):
    """Say what a method of contours will take where it is long; raises SceneError."""
    needed = _cost_of_contours(problem, float(max(omegas)))
    across = problem.sizes[:2] if problem.shape == "box" else problem.sizes[:1]
    body = f"{problem.shape} of {' by '.join(f'{size:g} m' for size in across)}: its contour"
    way_out = "give a less slender body, longer waves, or another method (--method panel, strip)"
    if problem.shapes:
        body, way_out = f"{len(problem.shapes)} bodies: their contours", "give longer waves or --method panel"
    verbs = ("need", "take") if problem.shapes else ("needs", "takes")
    check_memory(f"{body} {verbs[0]}", processes * needed.memory, way_out, SceneError)
    seconds = needed.table + len(omegas) * needed.each / processes
    check_seconds(f"{body} {verbs[1]}", seconds, way_out, SceneError)
    if console:
        told(f"{body} {verbs[1]}", seconds, partial(console.print, highlight=False, soft_wrap=True))


def _cost_of_contours(problem, omega):
    """`bem.contour.cost.Cost` for waves up to omega rad/s"""
    if problem.method == "transfer":
        from hakobune.bem.transfer.cost import cost

        return cost(problem.prepared().solver, omega, problem.gravity)
    if problem.shapes:
        from hakobune.bem.contour.several.cost import cost
    else:
        from hakobune.bem.contour.cost import cost

    return cost(problem.prepared().solver, float(wavenumber(omega, problem.depth, problem.gravity)))


def check_database(header, frequencies, headings, names):
    """Raise SceneError for a database larger than the memory in which it is laid out.

    header : `bem.database.file.Header`; frequencies, headings : their numbers; names : names of the quantities
    """
    lengths = {"influenced_dof": len(names_of(header.bodies, header.modes))}
    lengths["radiating_dof"] = len(moving(header.bodies, header.modes))
    lengths |= {"drift_dof": 3, "body": max(1, len(header.bodies))}
    lengths |= {
        "omega": frequencies,
        "wave_direction": headings,
        "theta": len(header.theta),
        "panel": header.mesh.total,
    }
    cells = 0
    for name in names:
        axes, _, kind = QUANTITIES[name]
        size = np.dtype(kind).itemsize * math.prod([lengths[axis] for axis in axes])
        cells += size * (2 if name in ESTIMATES else 1)
    check_memory(
        f"{frequencies} frequencies and {headings} headings need",
        COPIES * cells,
        "give fewer of them, or fewer quantities (--only)",
        SceneError,
    )


@dataclass(frozen=True)
class Telling:
    """Callback of `bem.kernels.progress`: announces a frequency that needs many more panels, with its time.

    console : console of rich; preparing : callback of everything else, or None
    """

    console: object
    preparing: object = None

    def __call__(self, stage, what):
        if stage != FINER:
            return self.preparing(stage, what) if self.preparing else None
        finer, omega = what
        if PER_PANEL * len(finer.problem.mesh) < NODES_WORTH_ASKING:
            return None
        text = f"ω {omega:.4g} rad/s: {finer.problem.mesh.total} panels for the tolerance need"
        return told(text, _seconds_alone(finer, [omega]), partial(self.console.print, highlight=False, soft_wrap=True))


def _check_memory(total, memory, processes):
    fewer = " or fewer processes (--executor)" if processes > 1 else ""
    check_memory(f"{total} panels need", memory, f"give fewer panels (--panels){fewer}", SceneError)


def _times(needed, limits):
    before, after = duration(needed.seconds), duration(limits * needed.seconds)
    return f", about {before} before the first frequency" + (
        f", about {after} for added mass at the limits" if limits else ""
    )


def _seconds_alone(prepared, omegas):
    from hakobune.bem.panels.band.cost import seconds_alone

    return seconds_alone(prepared, max(omegas, default=np.nan))


def _time_alone(prepared, omegas):
    seconds = _seconds_alone(prepared, omegas)
    return f", about {duration(seconds)} for each frequency" if seconds >= WORTH_TELLING else ""
