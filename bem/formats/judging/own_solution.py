"""The hull of imported results, solved by hakobune on the panels of this hull at two of the imported frequencies.

    Frequencies with k √A_w ≈ 0.4 and 1.2, A_w the waterplane area, or V^(2/3) of a submerged hull

The lower frequency has long waves, which need few panels and have no irregular frequencies; at the other frequency
the waves are five hulls long, and damping is significant.  The scale of each row is taken from the solution:
√(AᵢᵢAⱼⱼ), √(BᵢᵢBⱼⱼ), and the largest force of a mode over all headings.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ...kernels.progress import OWN, report_progress
from ...methods.panel_problem import PanelProblem
from ...modes import displacing
from ...waves import wavenumber
from ..values import Values

LONG = (0.4, 1.2)  # k times the size of the waterplane
READABLE = 4.0  # the same, above which the lowest frequency of a set is not a long wave
MOST_PANELS = 2500  # largest number of panels of the symmetric part; 8 s on one core
MOST_HEADINGS = 5
SMALL = 0.1  # forces of a mode below this fraction of the largest are compared with the largest
CANCELS = 0.05  # fraction of the lever arm
FAINT = 0.05  # the same for damping, over ω A
WANT = ("added_mass", "radiation_damping", "excitation_force")


@dataclass(frozen=True, eq=False)
class Own:
    """The hull (PanelMesh in its water), solved about `center` (3,) m when results are asked for"""

    mesh: object
    depth: float
    density: float
    gravity: float
    center: tuple = (0.0, 0.0, 0.0)
    nodes: int = 1  # per panel, as in most programs
    solved: dict = field(default_factory=dict)

    def at(self, omega, headings):
        """Added mass A (6, 6), damping B (6, 6) and excitation X (m, 6) in SI units"""
        turned = np.round(np.mod(headings, 2 * np.pi), 6)
        key = round(float(omega), 9)
        known = self.solved.get(key)
        if known is None or not set(turned.tolist()) <= set(known[2]):
            wanted = np.unique(np.concatenate([turned, np.round(np.mod(_images(turned), 2 * np.pi), 6)]))
            wanted = wanted if len(wanted) else np.zeros(1)  # any heading, for a set without forces
            report_progress(OWN, (self._prepared(), float(omega)))
            result = self._prepared().run(float(omega), wanted, frozenset(WANT), None, _dofs()).result()
            A, B, X = (result[name] for name in WANT)
            known = self.solved[key] = (A, B, dict(zip(wanted.tolist(), X, strict=True)))
        return known[0], known[1], np.array([known[2][angle] for angle in turned.tolist()]).reshape(-1, 6)

    def _prepared(self):
        if "prepared" not in self.solved:
            water = {"depth": self.depth, "density": self.density, "gravity": self.gravity}
            problem = PanelProblem(mesh=self.mesh, rotation_center=self.center, nodes_per_panel=self.nodes, **water)
            self.solved["prepared"] = problem.prepared()
        return self.solved["prepared"]

    def in_water(self, depth):
        """The same hull in water of another depth"""
        return self.solved.setdefault(("water", depth), replace(self, depth=depth, solved={}))

    @cached_property
    def draft(self):
        """m"""
        return -float(self.mesh.points[:, 2].min())

    def sharper(self):
        """The same hull with four nodes in each panel"""
        return self.solved.setdefault("sharper", replace(self, nodes=4, solved={}))

    @cached_property
    def moves(self):
        """Whether each mode displaces water; shape (6,)"""
        return displacing(self.mesh)

    @cached_property
    def arm(self):
        """Half the size of the hull, m"""
        return 0.5 * float(np.linalg.norm(np.ptp(self.mesh.whole().points, axis=0)))


def _dofs():
    from ... import DOFS

    return DOFS


def _images(headings):
    """Headings reversed, mirrored, and both, as in other conventions"""
    return np.concatenate([headings + np.pi, -headings, np.pi - headings])


def own_of(values, mesh):
    """`Own` of Values on their hull; None if there are other bodies, too many panels, or no long wave"""
    if values.others or len(mesh) > MOST_PANELS or any(values.get(name) is None for name in WANT[:2]):
        return None
    if not np.any(_sizes_of_waves(values, mesh) < READABLE):
        return None
    return Own(mesh, values.water_depth, values.density, values.gravity, tuple(values.rotation_center))


def _sizes_of_waves(values, mesh):
    plane = abs(float(mesh.whole().area_vectors[:, 2].sum()))
    volume = abs(float(mesh.volume))
    size = np.sqrt(plane) if plane > 1e-3 * volume ** (2 / 3) else volume ** (1 / 3)
    return wavenumber(values.omega, values.water_depth, values.gravity) * size


def sample(values, mesh):
    """The Values at one or two long waves and at most `MOST_HEADINGS` headings, for the comparison"""
    kL = _sizes_of_waves(values, mesh)
    rows = sorted({int(np.argmin(np.abs(np.log(kL / target)))) for target in LONG})
    m = len(values.wave_direction)
    columns = np.unique(np.linspace(0, m - 1, min(m, MOST_HEADINGS)).round().astype(int)) if m else np.zeros(0, int)
    quantities = {name: values.quantities[name][rows] for name in WANT if values.get(name) is not None}
    if "excitation_force" in quantities:
        quantities["excitation_force"] = quantities["excitation_force"][:, columns]
    body = {name: values.body[name] for name in ("hydrostatic_stiffness",) if name in values.body}
    return Values(values.omega[rows], values.wave_direction[columns], values.water_depth, values.density,
                  values.gravity, quantities, body, values.rotation_center)  # fmt: skip


def gaps(values, own):
    """{quantity: largest difference of a `sample` from hakobune's own solution, relative to the scale of the row}"""
    found = dict.fromkeys((name for name in WANT if name in values.quantities), 0.0)
    moves = own.moves
    for n, omega in enumerate(values.omega):
        A, B, X = own.at(omega, values.wave_direction)
        inertia = np.where(moves, np.sqrt(np.abs(np.diagonal(A))), np.inf)
        drain = np.where(moves, np.sqrt(np.maximum(np.diagonal(B), FAINT * omega * np.abs(np.diagonal(A)))), np.inf)
        for name, true, size in (("added_mass", A, inertia), ("radiation_damping", B, drain)):
            off = np.abs(values.quantities[name][n] - true) / np.outer(size, size)
            found[name] = max(found[name], float(np.max(off)))
        if "excitation_force" in found and len(X):
            off = np.abs(values.quantities["excitation_force"][n] - X) / sizes_of_forces(X, own)
            found["excitation_force"] = max(found["excitation_force"], float(np.max(off)))
    return found


def sizes_of_forces(X, own):
    """Scale of each of six forces X (m, 6): the largest force of the mode, or a tenth of the largest of all
    translations
        or rotations. A moment that nearly cancels about a point is compared with the largest force times `CANCELS`
        times the arm of the hull"""
    size = np.abs(X).max(axis=0)
    for part in (slice(0, 3), slice(3, 6)):
        size[part] = np.maximum(size[part], SMALL * np.max(size[part]))
    size[3:] = np.maximum(size[3:], CANCELS * own.arm * size[:3].max())
    return np.where(own.moves, size, np.inf)
