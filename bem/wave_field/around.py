"""The waves around one body of a database, or outside the outline around several, fixed or moving with the waves.

On a whole map, or at points in many waves.

η(p) = exp(ik·p) + Σ_j s_j H₀(k|p − p_j|), the sources s_j from the Kochin function of the diffraction and, if the body
moves, of its radiation times its motion (`sources`).  Local waves, which decay as exp(−πr/h) with the distance r from
the hull, are neglected.
"""

from typing import NamedTuple

import numpy as np

from ..algebra.convex_hull import convex_hull
from ..waves import wavenumber
from .sources import Sources, covers, directions, incident

SURFACE = 1e-6  # distance from the surface, over the draft, within which a hull point is on the waterline
CORNERS = 24  # corners that represent a curved plan


class WavesAround(NamedTuple):
    """One body, or several, in waves of 1 m towards one direction.

    omega rad/s, k rad/m, beta rad; sources : sources of its plan; middle : (2,) m of the plan; strengths : (s,) m
    motion : (n,) m and rad about the centre of rotation, None for a fixed body; missed : share of the far field that
    the sources do not send; pierces : whether the hull reaches the surface
    """

    omega: float
    k: float
    beta: float
    sources: Sources
    middle: np.ndarray
    strengths: np.ndarray
    motion: np.ndarray | None
    missed: float
    pierces: bool

    def elevation(self, places):
        """Complex elevation per metre of amplitude at places (p, 2), m; shape (p,). The surface is Re η exp(−iωt). nan
        in the plan of the body, or for several bodies in the outline around all"""
        places = np.atleast_2d(np.asarray(places, float))
        total = np.full(len(places), np.nan, complex)
        outside = ~self.sources.covers(places - self.middle) if self.pierces else np.ones(len(places), bool)
        there = places[outside]
        total[outside] = incident(self.k, np.array([self.beta]), there)[0]
        total[outside] += self.sources.elevation(self.strengths, there - self.middle)
        return total


def waves_around(reader, omega, beta, fixed=False):
    """`WavesAround` of a `Reader`'s body at omega (rad/s) and direction beta (rad).

    raises : BetweenError outside the database, without Kochin functions or, unless `fixed`, mass
    """
    k = float(wavenumber(omega, reader.depth, reader.gravity))
    plan, pierces = plan_of(reader.mesh)
    middle = (plan.min(axis=0) + plan.max(axis=0)) / 2
    motion = None if fixed else reader.motions([omega], [beta])[0, 0]
    H = far_field(reader, motion, omega, beta) * np.exp(1j * k * (directions(reader.between.theta) @ middle))
    sources = Sources(plan - middle, k, reader.between.theta)
    strengths, missed = sources.strengths(H)
    return WavesAround(float(omega), k, float(beta), sources, middle, strengths, motion, missed, pierces)


def beside_incident(reader, omega, headings, motions, places):
    """Waves that a `Reader`'s body adds at places: (q, p, n) complex, m per m, and the largest share missed.

    omega : (q,) rad/s; headings : (p,) rad; motions : (q, p, 6); places : (n, 2) m, see `at_waterline`
    missed : share of the far field that the sources miss, among the waves.  Raises as `waves_around`.
    """
    plan, _ = plan_of(reader.mesh)
    middle = (plan.min(axis=0) + plan.max(axis=0)) / 2
    radiated, diffracted = reader.far_field(omega, headings)
    H, away = diffracted + motions @ radiated, directions(reader.between.theta) @ middle
    found, missed = np.empty((len(H), H.shape[1], len(places)), complex), 0.0
    for q, k in enumerate(np.atleast_1d(wavenumber(omega, reader.depth, reader.gravity))):
        sources = Sources(plan - middle, k, reader.between.theta)
        strengths, share = sources.strengths(H[q] * np.exp(1j * k * away))
        found[q], missed = sources.elevation(strengths, places - middle), max(missed, share)
    return found, missed


def at_waterline(mesh, places):
    """Places (n, 2) in plan, m; shape (n, 2); places inside a hull are moved to the nearest point of its waterline"""
    plan, pierces = plan_of(mesh)
    places = np.array(places, float).reshape(-1, 2)
    over = covers(plan, places) if pierces else np.zeros(len(places), bool)
    side = np.roll(plan, -1, axis=0) - plan
    share = np.clip(np.sum((places[:, None] - plan) * side, axis=-1) / np.sum(side**2, axis=-1), 0, 1)
    feet = plan + share[..., None] * side
    nearest = np.linalg.norm(places[:, None] - feet, axis=-1).argmin(axis=1)
    return np.where(over[:, None], feet[np.arange(len(places)), nearest], places)


def far_field(reader, motion, omega, beta):
    """Kochin functions about the origin in waves towards beta (…,) rad, of motions (…, 6) or None for none; shape (…,
    t)"""
    betas = np.atleast_1d(beta)
    radiated, diffracted = reader.far_field([omega], betas)
    H = diffracted[0] if motion is None else diffracted[0] + np.atleast_2d(motion) @ radiated[0]
    return H[0] if np.ndim(beta) == 0 else H


def plan_of(mesh):
    """Corners anticlockwise of the convex hull of a PanelMesh's waterline, and whether the mesh has a waterline, m;
    shape (n, 2)

    A submerged body has the plan of all its panels.  A curved plan is represented by CORNERS corners.
    """
    points = mesh.whole().vertices.reshape(-1, 3)
    at_surface = points[:, 2] > -SURFACE * abs(points[:, 2].min())
    pierces = np.count_nonzero(at_surface) > 2 and bool(np.all(np.ptp(points[at_surface, :2], axis=0) > 0))
    flat = points[at_surface if pierces else slice(None), :2]
    plan = convex_hull(flat)
    if len(plan) <= CORNERS:
        return plan, pierces
    side = np.linalg.norm(np.roll(plan, -1, axis=0) - plan, axis=1)
    along = np.concatenate([[0.0], np.cumsum(side)])
    wanted = np.arange(CORNERS) / CORNERS * along[-1]
    closed = np.vstack([plan, plan[:1]])
    return np.stack([np.interp(wanted, along, column) for column in closed.T], axis=1), pierces
