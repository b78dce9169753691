"""`equation.Body` of a run: mass, restoring forces, damping, memory of the water, and forces given in time."""

import numpy as np

from hakobune.bem.time_domain.fast_states import slow_memory
from hakobune.bem.time_domain.memory_kernels import MemoryArrays

from ...lines.system.bodies import axes_in_space, places_along
from .. import slow_damping
from ..equation import Body, Shapes
from ..given_forces import sampled
from ..tables.groups import groups_of
from .failures import SimulationError
from .loads import frequency_of_coefficients, half_waves, mean_frequency, pairs

FASTEST, BAND = 8.0, 2.0  # rad/s and times the band of the database, of states of the memory, those beyond both follow
# at once: explicit steps of 0.4 s are stable; within the band they would give energy, as at the scale of a model
FILTER = 0.25  # frequency of the slow filter over the peak frequency of the waves
UNKNOWN = 0.4  # rad/s, mean frequency of waves if there are none


def body_of(moored, weather, settings, components, drag, munk):
    """`equation.Body` of a run.

    components : components of the waves, None for none; drag : N₂ of yaw of each body
    munk : whether the current coefficients include the moment of an ideal fluid on the drifting hull, which is then
        not added
    raises : SimulationError
    """
    reader, quadratic = moored.reader, moored.quadratic.copy()
    groups, rigid = groups_of(reader), reader.rigid
    quadratic[5:rigid:6] += drag
    added, damping, memory = _coefficients(moored, settings, components)
    damping = damping + reader.damping  # of the structure of bodies that bend
    try:
        pushed = *pairs(moored, weather, settings, components), *half_waves(moored, weather, settings, components)
        given = sampled((*weather.forces, *pushed), settings.ramp, settings.duration, rigid // 6)
    except ValueError as error:
        raise SimulationError(str(error)) from None
    each, ring = moored.waves.each[: rigid // 6], np.zeros((rigid // 6, 4, 6))
    drifts = all(one.drift is not None for one in each) and settings.slow_drift != "none"
    if components is not None and settings.wave_drift_damping and drifts:
        pairs_of = zip(each, moored.drift_slopes, strict=True)
        ring = np.array([slow_damping.drift_damping_ring(one.omega, B, weather) for one, B in pairs_of])
    shapes = shapes_of(reader, groups, moored.spring)
    inverse, free = np.zeros_like(damping), np.ix_(moored.free, moored.free)
    inverse[free] = np.linalg.inv((reader.inertia + added)[free])
    turning = weather.on_hull is None or not weather.on_hull.turning  # turning tests hold the inertia of the turn
    own = slice(0, rigid), slice(0, rigid)
    return Body(
        groups.padded(inverse, 2),
        turning * of_each(reader.inertia[own]),
        turning * of_each(moored.slow_added_mass[own]),
        of_each(reader.stiffness[own]),
        of_each(on_places(moored.spring[own], reader.axes_at_rest[:, 5])),
        groups.padded(damping, 2),
        groups.padded(quadratic),
        np.ascontiguousarray(reader.axes_at_rest[:, 5]),
        FILTER * (UNKNOWN if components is None else mean_frequency(components)),
        float(settings.ramp),
        np.array((0.0, settings.ramp) if settings.wave_ramp is None else settings.wave_ramp, float),
        0.0 if munk else 1.0,
        MemoryArrays(memory.decay, memory.turn, groups.padded(memory.input), groups.padded(memory.output)),
        ring,
        *given,
        shapes,
        shapes if shapes.place.size else None,
    )


def shapes_of(reader, groups, spring):
    """`equation.Shapes` of the `Groups` of a Reader; spring : (n, n) in addition to water, weight and structure"""
    K = reader.stiffness + spring
    K[: reader.rigid, : reader.rigid] = 0.0
    return Shapes(groups.owner, groups.place, groups.padded(K, 2))


def of_each(matrix):
    """Diagonal blocks (N, 6, 6), one for each body, of a matrix (6N, 6N)"""
    return np.array([matrix[i : i + 6, i : i + 6] for i in range(0, len(matrix), 6)])


def on_places(spring, headings):
    """A spring (6N, 6N) along the axes of bodies with headings (N,) rad, converted to displacements in space"""
    turn = places_along(headings)
    return turn @ spring @ turn.T


def in_space(matrix, headings):
    """A matrix (6N, 6N) along the axes of bodies with headings (N,) rad, converted to the axes of space"""
    turn = axes_in_space(headings)
    return turn @ matrix @ turn.T


def _coefficients(moored, settings, components):
    """Added mass and damping (n, n), and `MemoryArrays` of the slower response.  Raises SimulationError."""
    if settings.memory != "constant":
        memory = moored.memory
        slow = slow_memory(memory, max(FASTEST, BAND * memory.band[1]))
        return memory.added_mass_infinity + slow.inertia, moored.damping + slow.damping, slow.arrays
    omega = frequency_of_coefficients(settings, components)
    if omega is None:
        raise SimulationError(
            'memory = "constant" uses coefficients at the mean wave frequency, and there are no waves; '
            'give waves, or memory = "states"'
        )
    (added,), (radiated,) = moored.reader.coefficients(np.array([omega]))
    if np.linalg.eigvalsh(moored.reader.inertia + added).min() <= 0:
        raise SimulationError(
            f"mass and added mass at {omega:.3g} rad/s are not positive, which resonant water in front of a "
            "wall can cause; give another constant_period"
        )
    none = np.zeros((len(added), 0))
    return added, moored.damping + radiated, MemoryArrays(np.zeros(0), np.zeros(0), none, none)
