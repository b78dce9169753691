"""Waves around one body of a database, or outside the outline around several bodies, fixed or moving.

The elevation, on a map or at points in many waves, is η(p) = exp(ik·p) + Σ_j s_j H₀(k|p − p_j|). The sources s_j follow
from the Kochin function of the diffraction and, if the body moves, that of the radiation times the motion
(`sources`).  Local waves, which decay as exp(−πr/h) with the distance r from the hull, are neglected.
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

    omega : rad/s; k : rad/m; beta : rad; sources : `Sources` in the plan; middle : middle of the plan, m, (2,)
    strengths : strengths of the sources, m, (s,); motion : motions about the rotation centre, m and rad, (n,), or
        None for a fixed body
    missed : share of the far field that the sources do not reproduce; pierces : whether the hull reaches the surface
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
        """Complex elevation per metre of amplitude at places (p, 2), m; shape (p,). The surface is Re η exp(−iωt).
        The elevation is nan in the plan of the body, or, for several bodies, in the outline around all bodies"""
        places = np.atleast_2d(np.asarray(places, float))
        total = np.full(len(places), np.nan, complex)
        outside = ~self.sources.covers(places - self.middle) if self.pierces else np.ones(len(places), bool)
        there = places[outside]
        total[outside] = incident(self.k, np.array([self.beta]), there)[0]
        total[outside] += self.sources.elevation(self.strengths, there - self.middle)
        return total


def waves_around(reader, omega, beta, fixed=False):
    """`WavesAround` of a `Reader`'s body at omega (rad/s) and direction beta (rad).

    raises : BetweenError outside the stored waves, without Kochin functions, and, unless `fixed`, without mass
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
    """Waves that a `Reader`'s body adds at places, complex, m per m, (q, p, n), and the largest share missed in any
    wave.

    omega : rad/s, (q,); headings : rad, (p,); motions : (q, p, 6); places : m, (n, 2), see `at_waterline`.
    The share missed is the part of the far field that the sources do not reproduce.  Raises the errors of
    `waves_around`.
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
    """Kochin functions about the origin in waves towards beta (…,) rad, for motions (…, 6), or None without motions;
    shape (…, t)"""
    betas = np.atleast_1d(beta)
    radiated, diffracted = reader.far_field([omega], betas)
    H = diffracted[0] if motion is None else diffracted[0] + np.atleast_2d(motion) @ radiated[0]
    return H[0] if np.ndim(beta) == 0 else H


def plan_of(mesh):
    """Corners, m, anticlockwise, of the convex hull of a PanelMesh's waterline, (n, 2), and whether the mesh has a
    waterline

    For a submerged body the plan is that of all panels.  CORNERS corners represent a curved plan.
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
