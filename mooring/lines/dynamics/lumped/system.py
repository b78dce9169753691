"""Data of a line for the kernels: arrays per element, per node, and of the bed, the water and the fairlead's motion.

N elements join nodes 0 (anchor) to N (fairlead).  Each element gives half of its length to either end node.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory


@in_memory
class System(NamedTuple):
    """Arrays per element (N,), where "half" means half an element; arrays per node (N + 1,); the bed as scalars and
    a vector.
    """

    length: np.ndarray  # m, unstretched
    stiffness: np.ndarray  # EA, N, the largest of a table
    elongation_rows: (
        np.ndarray
    )  # (N, 2) first row of each element's material in `elongation`, and the one after its last
    elongation: np.ndarray  # (m, 4) strain from which a row holds; tension there, its slope and its integral, over EA
    damping: np.ndarray  # BA, N s
    soft_strain: np.ndarray  # strain below which damping fades out
    half_mass: np.ndarray  # kg
    half_drag_normal: np.ndarray  # ½ρ C D ℓ/2, kg/m
    half_drag_tangential: np.ndarray
    half_added_normal: np.ndarray  # kg
    half_added_tangential: np.ndarray
    half_displaced: np.ndarray  # kg of water
    buoyancy: np.ndarray  # N, additional weight of a whole element in air; all 0 where a line counts as submerged
    waterline: np.ndarray  # m, πD/4, over which a level element leaves the water
    weight: np.ndarray  # N, submerged weight of the line plus dry weight of the body at the node
    flexure: np.ndarray  # N m, against relative rotation of the elements on both sides, 0 for hinges; () without any
    mass: np.ndarray  # kg, line and body, without water
    inertia: np.ndarray  # kg, with all added mass: scale of the error estimate
    body_nodes: np.ndarray  # (b,) where the bodies are
    body_buoyancy: np.ndarray  # N, wholly under water
    body_radius: np.ndarray  # m, of the sphere of its volume
    body_drag: np.ndarray  # ½ρ C_d A, kg/m
    body_added: np.ndarray  # kg
    body_displaced: np.ndarray  # kg of water
    bed_stiffness: np.ndarray  # N/m; 0 without a bed
    bed_damping: np.ndarray  # N s/m
    bed_thickness: np.ndarray  # m, penetration of the node at rest
    bed_normal: np.ndarray  # (3,)
    bed_level: float  # n·r of the bed, where a line rests
    bed_friction: float
    bed_slip: float  # m, displacement at which friction is fully mobilised
    bed_course: np.ndarray  # (4,) m, x and y of its begin, and the unit vector along it
    bed_profile: np.ndarray  # (k, 4) m along the course from which a row holds; height there, slope, bend; none: plane


@in_memory
class Water(NamedTuple):
    """Current (k, 2), m/s, at levels (k,), and waves (w,) or (w, 2); depth may be inf.

    Instead of waves there may be a table of their sums at places of n nodes (`motion.moving_lines.sea`).
    """

    level: np.ndarray
    current: np.ndarray
    amplitude: np.ndarray
    omega: np.ndarray
    wavenumber: np.ndarray
    heading: np.ndarray  # (w, 2) unit vectors
    phase: np.ndarray  # rad, lag
    depth: float
    ramp: float  # s
    begin: float  # s, of the ramp
    current_ramp: float  # s, 0 for a current that exists from the start
    table: np.ndarray  # (6 · 8 n,) velocity and gradient of all nodes at each of six times, and eight numbers more
    place: np.ndarray  # (3 n,) m, all x, y and z, and eight numbers more
    clock: np.ndarray  # (2,) s, first time and step
    weights: np.ndarray  # (2, 6) room for work
    met: np.ndarray  # (w,) rad/s, frequency at which the waves pass a place at rest
    carried: np.ndarray  # (2,) m/s, at which a current carries waves


class Motion(NamedTuple):
    """r(t) = piecewise cubics + ramp · Re Σ X exp(−iωt)."""

    knots: np.ndarray  # (k + 1,) s
    cubics: np.ndarray  # (k, 4, 3) coefficients of 1, τ, τ², τ³ with τ from the knot
    omega: np.ndarray  # (m,)
    real: np.ndarray  # (m, 3)
    imag: np.ndarray  # (m, 3)
    ramp: float  # s


class Control(NamedTuple):
    """Tolerances and step limits of a run."""

    tolerance: float
    tension: float  # N, least scale of tension
    distance: float  # m, scale of position
    longest: float  # s
    shortest: float  # s


class State(NamedTuple):
    """State from which a run continues; arrays (N + 1, 3)."""

    time: float
    position: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    slip: np.ndarray  # m, elastic displacement of the bed friction
    step: float


def above_bed(system, q):
    """Height of points q (n, 3) over the bed, along its normal, m; shape (n,)"""
    profile = system.bed_profile
    if len(profile) == 0:
        return q @ system.bed_normal - system.bed_level
    d = (q[:, :2] - system.bed_course[:2]) @ system.bed_course[2:]
    begin, height, slope, bend = profile[np.maximum(np.searchsorted(profile[:, 0], d, side="right") - 1, 0)].T
    more = d - begin
    return (q[:, 2] - height - more * (slope + 0.5 * bend * more)) / np.hypot(1.0, slope + bend * more)


def elastic_tension(system, q):
    """Elastic tension, N, without damping, of the elements between nodes at q (N + 1, 3) m; shape (N,)"""
    strain = np.maximum(np.linalg.norm(np.diff(q, axis=0), axis=1) / system.length - 1, 0.0)
    begins = system.elongation[:, 0]
    places = zip(system.elongation_rows, strain, strict=True)
    rows = [first + np.searchsorted(begins[first:last], e, side="right") - 1 for (first, last), e in places]
    begin, tension, slope, _ = system.elongation[rows].T
    return system.stiffness * (tension + slope * (strain - begin))
