"""A body in front of a reflecting wall, computed from its results in open water with all reflections.

The wall is at y = w, and p′ is the mirror image of a point p in the wall.  The sources s of a body's waves (`sources`)
respond to the wave towards β, the reflection of this wave, and the waves from equal sources of the body's image:

    s = F [H(β) + e^{2ikw sinβ} H(−β) + M s],    M_ti = η(p′_i; θ_t + π)
    f = F(β) + e^{2ikw sinβ} F(−β) + C Σ s_i ηⱼ(p′_i),    C = −4iρg n/k²,  n = C_g/C

F fits sources to a far field.  By reciprocity, the wave that the body scatters towards θ from a source at p equals
the wave that the body scatters to p from a plane wave towards θ + π. The source exerts the force C ηⱼ(p) on the body,
with ηⱼ the wave at p due to motion j, which is Haskind's relation for a near source.  For the sources of motion j the
second equation gives ω²ΔA + iωΔB in place of f.  Drift is the mean force of waves on the sources,

    D = (2ρg n/k²) Σ Im s_i ∇η*(p_i),

where η is the sum of all incident waves and the regular part J₀ of the waves from the body's own sources. The yaw
moment is the moment of these forces. The report (SR179, 1982, section 3.7.3) is two-dimensional, includes only one
wave that passes under the body and returns, and multiplies motions by a factor π (`bem.sections.quay`).  This module
includes the ends of the body, every reflection, added mass, damping and drift.
Local waves between hull and image are `neglected`.  For a box of 200 × 50 × 10 m in waves of 0.15 to 0.95 rad/s and
20 m of water, forces differ from those of the panel method with the wall by 0.4 % of the largest force if the hull is
25 m from the wall, by 2.3 % at 10 m, and by 60 % at 3 m. In 100 m of water forces differ by 4 % at 25 m and by 33 %
at 10 m.
"""

from dataclasses import replace

import numpy as np

from ..drift import about
from ..waves import group_factor, wavenumber
from .around import plan_of
from .sources import Sources, directions, incident, slopes, waves

HEADINGS = 72  # number of computed headings, one every 5°
TURN = 0.25  # rad of 2kw between frequencies: a wave to the wall and back
FEWEST, MOST = 100, 400  # frequencies
CHANGE = 0.15  # change of radiation between neighbours, over its largest value, above which a frequency is inserted
FINEST = 2e-4  # smallest relative step between neighbouring frequencies
AT_ONCE = 16
NEEDED = ("added_mass", "radiation_damping", "excitation_force", "kochin_radiation", "kochin_diffraction")


class WallError(ValueError):
    """The behaviour in front of a wall cannot be computed from a database; the message gives the reason and a
    remedy."""


def neglected(body, wall):
    """Height of a local wave that has travelled from the hull to the image and back, as a share of its initial height

    The share is exp(−2πg/b), with g the gap from hull to wall, and b the depth or, in deeper water, the breadth of the
    hull. For the box of the module at 25 and 10 m in 100 m of water the share is 0.04 and 0.28, and the relative
    errors of sway are 0.04 and 0.30. At 25, 10 and 3 m in 20 m of water the share is 0.0004, 0.04 and 0.39, and the
    relative errors of forces are 0.004, 0.02 and 0.6.
    """
    low, high = _breadth(body)
    return float(np.exp(-max(wall - high, low - wall) / _decay(body.depth, high - low)))


def least_gap(share, depth, breadth):
    """Distance from hull to wall, m, at which `neglected` is equal to `share`"""
    return -float(np.log(share)) * _decay(depth, breadth)


def _decay(depth, breadth):
    """m, distance over which a local wave falls to 1/e on its way to the wall and back"""
    return min(depth, breadth) / (2 * np.pi)


def before_wall(body, wall):
    """`bem.database.reader.Reader` of a `Reader`'s body in front of a wall at y = wall, m

    The result has added mass, damping, forces and, for a body with inertia, drift, at frequencies that resolve the
    interference of waves which travel to the wall and back.
    raises : WallError if the database lacks needed quantities or has a wall already, or if the body reaches the wall
    """
    _check(body, wall)
    body = body if body.inertia is None or body.stiffness is None else body.floating()
    beta = np.arange(HEADINGS) * (2 * np.pi / HEADINGS)
    omega, rows = np.zeros(0), []
    wanted = _frequencies(body, wall)
    while len(wanted):
        for part in np.array_split(wanted, max(1, len(wanted) // AT_ONCE)):
            rows += _at(body, wall, part, beta)
        omega = np.concatenate([omega, wanted])
        order = np.argsort(omega)
        omega, rows = omega[order], [rows[i] for i in order]
        wanted = _between(omega, rows)
    names = [name for name, value in rows[0].items() if value is not None]
    quantities = {name: np.array([row[name] for row in rows]) for name in names}
    limits = {name: m for name, m in body.between.limits.items() if name == "added_mass_infinity"}
    between = replace(body.between, omega=omega, quantities=quantities, headings=beta, limits=limits, wall=float(wall))
    return replace(body, between=between, symmetry=body.symmetry.replace("y", ""), is_round=False, own=True)


def given_back(body):
    """Size of negative radiated energy, 0 or more: minus the lowest eigenvalue of damping, scaled by the largest
    damping of each motion

    Negative energy is an error of the result. For the box of the module with headings stored every 15° its size is
    1e-4 at 25 m and 0.02 at 50 m from the wall; with headings every 30° it is 0.12.
    Sharp resonances between hull and wall are sensitive to errors.
    """
    B = body.between.quantities["radiation_damping"]
    size = np.sqrt(np.einsum("nii->ni", B).max(axis=0))
    size = np.where(size > 0, size, np.inf)
    return float(max(0.0, -np.linalg.eigvalsh(B / np.outer(size, size)).min()))


def _check(body, wall):
    if body.between.wall is not None:
        raise WallError(
            f"the database already has a wall at y = {body.between.wall:g} m; allowed: a database of open water"
        )
    missing = [name for name in NEEDED if name not in body.between.quantities]
    if missing:
        raise WallError(
            f"a wall needs {', '.join(missing)} in the database; repeat the command that made it, with "
            "--only kochin,radiation"
        )
    if body.mesh is None:
        raise WallError("a wall needs the mesh of the body, which the database lacks; solve it again")
    low, high = _breadth(body)
    if not (np.isfinite(wall) and (wall > high or wall < low)):
        raise WallError(f"a wall at y = {wall:g} m intersects the hull; allowed: below {low:g} or above {high:g} m")


def _breadth(body):
    y = plan_of(body.mesh)[0][:, 1]
    return float(y.min()), float(y.max())


def _frequencies(body, wall):
    """Stored frequencies and as many between them as waves to the wall and back need, rad/s; shape (q,)"""
    low, high = body.between.span
    k = wavenumber(np.array([low, high]), body.depth, body.gravity)
    count = int(np.clip(2 * abs(wall) * np.ptp(k) / TURN, FEWEST, MOST))
    fine = np.linspace(low, high, 2000)
    phase = 2 * abs(wall) * wavenumber(fine, body.depth, body.gravity) / TURN + FEWEST * (fine - low) / (high - low)
    even = np.interp(np.linspace(phase[0], phase[-1], count), phase, fine)
    stored = body.omega[:, None]
    even = even[np.min(np.abs(even - stored), axis=0) > 1e-3 * (high - low)]
    return np.sort(np.concatenate([body.omega, even]))


def _between(omega, rows):
    """Frequencies halfway where radiation changes much: water between hull and wall has sharp resonances"""
    A, B = (np.array([row[name] for row in rows]) for name in ("added_mass", "radiation_damping"))
    Z = B - 1j * omega[:, None, None] * (A - A[-1])
    size = np.sqrt(np.abs(np.einsum("nii->ni", Z)).max(axis=0))
    size[size == 0] = np.inf
    change = (np.abs(np.diff(Z, axis=0)) / np.outer(size, size)).max(axis=(1, 2))
    where = np.flatnonzero((change > CHANGE) & (np.diff(omega) > FINEST * omega[1:]))
    room = max(0, MOST - len(omega))
    where = np.sort(where[np.argsort(-change[where])[:room]])
    return 0.5 * (omega[where] + omega[where + 1])


def _at(body, wall, omega, beta):
    """Rows {name: value} of `before_wall` at omega (q,) rad/s and headings beta (b,) rad"""
    theta = np.asarray(body.between.theta)
    radiated, diffracted = body.far_field(omega, np.concatenate([theta + np.pi, beta, -beta]))
    forces = body.forces(omega, np.concatenate([beta, -beta]))
    rows = zip(omega, radiated, diffracted, forces, *body.coefficients(omega), strict=True)
    plan, _ = plan_of(body.mesh)
    return [_one(body, wall, plan, theta, beta, *row) for row in rows]


def _one(body, wall, plan, theta, beta, omega, radiated, diffracted, forces, A, B):
    k = float(wavenumber(omega, body.depth, body.gravity))
    scale = body.density * body.gravity * float(group_factor(k, body.depth)) / k**2
    sources, t, b = Sources(plan, k, theta), len(theta), len(beta)
    points = sources.points
    image = points * [1, -1] + [0, 2 * wall]
    passed = waves(k, image, points)
    scattered, of_motion = sources.strengths(diffracted)[0], sources.strengths(radiated)[0]
    answer = np.eye(len(points)) - sources.of_far_field @ (scattered[:t] @ passed.T)
    turn = np.exp(2j * k * wall * np.sin(beta))[:, None]
    first = scattered[t : t + b] + turn * scattered[t + b :]
    strengths = np.linalg.solve(answer, np.concatenate([first, of_motion]).T).T
    press = -4j * scale * strengths @ (of_motion @ passed.T).T  # force on the modes, by waves of headings and motions
    force, own = forces[:b] + turn * forces[b:] + press[:b], 0.5 * (press[b:] + press[b:].T)
    A, B = A + own.real / omega**2, B + own.imag / omega
    row = {"added_mass": A, "radiation_damping": B, "excitation_force": force, "drift_force": None}
    if body.inertia is None or body.stiffness is None:
        return row
    held = -(omega**2) * (body.inertia + A) - 1j * omega * (B + body.damping) + body.stiffness
    total = strengths[:b] + np.linalg.solve(held, force.T).T @ strengths[b:]
    towards = np.stack([directions(beta), directions(-beta)])
    met = np.stack([incident(k, beta, points), turn * incident(k, -beta, points)])
    slope = 1j * k * np.einsum("wbi,wba->bia", met, towards)
    slope += np.einsum("bl,ila->bia", total, slopes(k, points, image) + slopes(k, points, points).real)
    brought = 2 * scale * np.imag(total[..., None] * slope.conj())
    moment = points[:, 0] * brought[..., 1] - points[:, 1] * brought[..., 0]
    drift = np.concatenate([brought.sum(axis=1), moment.sum(axis=1)[:, None]], axis=1)
    return row | {"drift_force": about(drift, body.rotation_center)}
