"""A scene solved as the commands do: scene, mesh, lid, method, one frequency; nothing is stored."""

from dataclasses import dataclass

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.database.schema import LIMITS
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import prepare

from ...scene.methods import METHODS
from ...scene.scene import make_scene
from ...solve.plan import planned

QUANTITIES = ("added_mass", "radiation_damping", "excitation_force")


@dataclass(frozen=True)
class Solved:
    """Z = A + iB/ω (6, 6) and excitation X (m, 6), and their sizes as in `bem.checks`.

    panels : on the whole hull, 0 where none is computed with; result : result of the solver
    """

    method: str
    panels: int
    Z: np.ndarray
    X: np.ndarray
    sizes: tuple
    result: dict

    @property
    def estimate(self):
        """Relative error of A, B and X that is stored with the result"""
        return self.result["checks"].get("estimated_error", np.nan)

    def relative(self, Z, X):
        """Coefficients of a like scene, divided by the sizes of this one"""
        return Z / self.sizes[0], X / self.sizes[1]


def solved(scene, method="auto", tolerance=0.01):
    """`Solved` of a `StressScene`.  Raises what the commands report: ValueError, FloatingPointError."""
    checked = make_scene(scene.tables(method, tolerance))
    plan = planned(checked)
    prepared, omega, names = prepare(plan.problem), plan.omegas[0], set(plan.names) - set(LIMITS)
    # the order in which they were drawn, not the ascending one of a database
    result = solve_frequency(prepared, omega, np.radians(scene.headings), names, plan.header.theta)
    chosen = checked.solved_by
    panels = plan.header.mesh.total if METHODS[chosen].panels else 0
    return scaled(chosen, panels, prepared, omega, result)


def scaled(method, panels, prepared, omega, result):
    """`Solved` of a result"""
    Z, X = result["added_mass"] + 1j * result["radiation_damping"] / omega, result["excitation_force"]
    sizes = radiation_sizes(Z, prepared.displacing), excitation_sizes(X, result["diffraction_force"], prepared)
    return Solved(method, panels, Z, X, sizes, result)


def radiation_sizes(Z, displacing):
    """Scales √|Zᵢᵢ Zⱼⱼ|, infinite for modes that move no water; shape (6, 6)"""
    size = np.where(displacing, np.sqrt(np.abs(np.diag(Z))), np.inf)
    return np.outer(size, size)


def excitation_sizes(excitation, diffraction, prepared):
    """Scales as in `bem.checks.excitation_scale`; shape (6,)"""
    size = np.maximum(np.abs(excitation), np.abs(diffraction)).max(axis=0)
    force = 0.2 * size[:3].max()
    least = np.repeat([force, max(0.2 * size[3:].max(), 0.5 * force * prepared.radius)], len(DOFS) // 2)
    return np.where(prepared.displacing, np.maximum(size, least), np.inf)
