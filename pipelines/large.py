"""Large panel problems: which frequencies share their work, what it takes, and whether it fits."""

from __future__ import annotations

from bem.setup import Setup
from bem.shape_setup import ShapeSetup

from .progress import duration
from .scene import SceneError

PER_PANEL = 4  # nodes
WORTH_SHARING = 10, 400  # frequencies, and nodes of a symmetric part, from which the preparation pays
ONLY_SHARED = 5000  # nodes from which the equations of a single frequency would not fit
WORTH_TELLING = 3000


def shared_band(scene, mesh):
    """(low, high) rad/s of frequencies that share their work (`bem.reduced`), or None"""
    omegas, nodes = scene.omegas(), PER_PANEL * len(mesh)
    many = scene.waves.band is not None or len(omegas) >= WORTH_SHARING[0]
    if nodes > ONLY_SHARED or (many and nodes >= WORTH_SHARING[1]):
        return float(omegas.min()), float(omegas.max())
    return None


def announced(setup, limits, console, processes=1):
    """Say what a large problem will take.  Raises SceneError if the memory is not there.

    limits : how many limits of the frequency are still to be computed; processes : that each prepare the body
    """
    panels = setup.panels if isinstance(setup, ShapeSetup) else setup
    if not isinstance(panels, Setup) or panels.band is None or PER_PANEL * len(panels.mesh) < WORTH_TELLING:
        return
    from bem.cost import available_memory, cost

    total, free = panels.mesh.total, available_memory()
    needed = cost(panels.prepared().geometry, panels.band, panels.gravity)
    memory = processes * needed.memory
    if memory > free:
        raise SceneError(
            f"{total} panels need about {memory / 1e9:.1f} GB, {free / 1e9:.1f} GB are free; "
            "give fewer panels (--panels)" + (" or fewer processes (--executor)" if processes > 1 else "")
        )
    if console:
        before, after = duration(needed.seconds), duration(limits * needed.seconds)
        last = f", about {after} for added mass at the limits" if limits else ""
        console.print(
            f"{total} panels: about {memory / 1e9:.1f} GB, about {before} before the first frequency{last}",
            highlight=False,
            soft_wrap=True,
        )
