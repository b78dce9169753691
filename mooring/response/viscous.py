"""Viscous damping in irregular waves by equivalent linearisation.

A law of `bem.viscous` gives the linear damping that dissipates equal energy in a regular motion of amplitude a at ω.
For irregular motion with standard deviations σ and σ_v the law is evaluated at ω = σ_v/σ and a = 1.88 σ. For
quadratic drag N₂ this gives √(8/π) σ_v N₂, the smallest mean square difference for a Gaussian motion (Borgman 1969).
 Motion and damping depend on each other and are found by the secant rule.

Every study uses the laws of a database's scene through this module: in a sea (`in_sea`), in regular waves
(`in_regular_waves`, with equal dissipation per cycle), and in time (`in_time`, where a drag remains quadratic).
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hakobune.bem.viscous import EQUIVALENT_AMPLITUDE, Quadratic, Tabulated, Viscous, linearised_response

from ..on_current.body import carrier_of_body
from .linear import frequencies, moments, moments_met, response_spectrum
from .seas import directions, heading_step

FIRST = 0.05  # m, rad, of the first guess
CLOSE = 1e-6
MOST = 60
RESTORED = [2, 3, 4]  # heave, roll, pitch


class InTime(NamedTuple):
    """A body's viscous damping in time, in addition to radiation

    quadratic : N₂ of laws that are a drag, (n,); damping : damping of all other laws, linearised in the waves, (n, n)
    body : `bem.database.reader.Reader`, floating, with the drift of the body as damped in these waves
    """

    quadratic: np.ndarray
    damping: np.ndarray
    body: object


def laws_of(reader):
    """{degree of freedom: law} of the scene of a `bem.database.reader.Reader`, {} without laws"""
    return {} if reader.viscous is None else reader.viscous.laws


def in_sea(reader, sea, laws=None, held=None):
    """A `Reader`, floating, with viscous damping linearised in a Sea; and this viscous damping (n, n).

    laws : laws in place of the laws of its scene; held : the floating Reader with its restraint, None for a free body
    raises : as `linearised` and `Reader.floating`
    """
    laws, body = laws_of(reader) if laws is None else laws, reader.floating() if held is None else held
    return linearised(body, sea, laws) if laws else (body, np.zeros_like(body.damping))


def in_regular_waves(reader, omega, amplitude, direction):
    """A `Reader`, floating, with the viscous damping of its scene in regular waves; and this viscous damping (6, 6).

    omega : rad/s; amplitude : m; direction : rad, travelled to
    """
    laws, body = laws_of(reader), reader.floating()
    if not laws:
        return body, np.zeros_like(body.damping)
    (A,), (B,) = body.coefficients(np.array([omega]))
    force = body.forces(np.array([omega]), np.array([direction]))[0]
    viscous = replace(reader.viscous, wave_amplitude=amplitude)
    _, (damping,) = linearised_response(omega, A, B + body.damping, force, body.inertia, body.stiffness, viscous)
    return body.restrained(damping=damping), damping


def in_time(reader, waves=None, damping=None, quadratic=None):
    """`InTime` of a `Reader` in waves: a Sea, regular `mooring.studies.conditions.Waves`, or None.

    Without waves only laws in the form of a drag act.
    damping : (n, n), and quadratic : (n,), of a study, in addition to the laws of the scene. Their heave, roll and
        pitch parts affect the drift, since waves excite these resonances; damping of slow motions does not
    """
    names, count = reader.names, len(reader.names)
    linear = np.zeros((count, count)) if damping is None else np.asarray(damping, float)
    drag = np.zeros(count) if quadratic is None else np.array(quadratic, float)
    laws, restored = dict(laws_of(reader)), [i for i in range(reader.rigid) if i % 6 in RESTORED]
    for i, dof in enumerate(names):
        if isinstance(laws.get(dof), Quadratic):
            drag[i] += laws[dof].drag
        if drag[i] > 0 and i in restored and not isinstance(laws.get(dof), Tabulated):
            laws[dof] = Quadratic(drag[i])
    held = np.zeros((count, count))
    held[restored, restored] = linear[restored, restored]
    body, added = reader.floating().restrained(damping=held), np.zeros((count, count))
    if waves is not None and laws and hasattr(waves, "spectrum"):
        body, added = linearised(body, waves, laws)
    elif waves is not None and laws:
        damped = replace(body, viscous=Viscous(laws, 0.5 * waves.height))
        body, added = in_regular_waves(damped, waves.omega, 0.5 * waves.height, waves.direction)
    if not reader.rebuilds_drift:  # only the stored drift is known, in the waves of the scene
        body = replace(reader, viscous=None)
    added = linear + added
    for i, dof in enumerate(names):
        if isinstance(laws.get(dof), Quadratic):
            added[i, i] = linear[i, i]
    return InTime(drag, added, body)


def linearised(body, sea, laws):
    """The `bem.database.reader.Reader` with viscous damping in a Sea; and this viscous damping (n, n).

    laws : {degree of freedom: law of `bem.viscous`}
    raises : ValueError if no damping is consistent with its own motion
    """
    middle = 2 * np.pi / sea.spectrum.T01
    damping = np.array([laws[d].equivalent(middle, FIRST) if d in laws else 0.0 for d in body.names])
    first = body.restrained(damping=np.diag(damping))
    step = heading_step(first, sea, frequencies(first, sea.spectrum.density))
    before, damping_before = None, None
    for _ in range(MOST):
        found = _damping(body.restrained(damping=np.diag(damping)), sea, laws, step)
        if np.all(np.abs(found - damping) <= CLOSE * np.maximum(found, damping)):
            return body.restrained(damping=np.diag(found)), np.diag(found)
        share = 2 / 3 if before is None else _share(_ratio(damping, damping_before), _ratio(found, before))
        damping_before, before = damping, found
        damping = damping ** (1 - share) * found**share
    raise ValueError(
        f"the iteration of viscous damping and motion did not converge in {MOST} passes; give linear damping"
    )


def _ratio(a, b):
    return np.divide(a, b, out=np.ones_like(a), where=b > 0)


def _share(step, answer):
    """Share of the damping found in the next guess: secant in logarithms; ⅔ for quadratic drag, as σ_v ∝ damping^−½;
    shape (n,)"""
    moved = (step > 0) & (answer > 0) & (np.abs(step - 1) > 1e-12)
    slope = np.log(np.where(moved, answer, 1.0)) / np.log(np.where(moved, step, 2.0))
    return np.where(moved, 1 / (1 - np.clip(slope, -3.0, 0.5)), 2 / 3)


def _damping(body, sea, laws, step):
    """Damping at the motion of a body that already has some damping; shape (n,); step : degrees between directions"""
    omega = frequencies(body, sea.spectrum.density)
    heading, weights = directions(sea, omega, step)
    X, density = body.motions(omega, heading), sea.spectrum.density(omega)
    if carrier_of_body(body) is None:
        found = moments(omega, response_spectrum(X, density, weights))
    else:
        found = moments_met(omega, body.encounter(omega, heading), X, density, weights)
    out = np.zeros(len(body.names))
    for i, dof in enumerate(body.names):
        if dof in laws and found.m0[i] > 0:
            frequency = np.sqrt(found.m2[i] / found.m0[i])
            out[i] = laws[dof].equivalent(frequency, EQUIVALENT_AMPLITUDE * np.sqrt(found.m0[i]))
    return out
