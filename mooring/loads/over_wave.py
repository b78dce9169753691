"""Forces on straight members over one regular wave; the force acts on the part below the instantaneous surface."""

from typing import NamedTuple

import numpy as np

from .morison import Section, member_force


class Member(NamedTuple):
    """name; its `Section`, growth included; start, end (3,) m"""

    name: str
    section: Section
    start: np.ndarray
    end: np.ndarray

    @property
    def foot(self):
        """The lower end of the member, m; shape (3,)"""
        return min(self.start, self.end, key=lambda end: end[2])


def over_wave(member, wave, phases, density):
    """Force and moment, N and N m, on a Member in a RegularWave, about the foot of the Member, at phases (p,), rad;
    shape (p, 6)"""
    force = np.zeros((len(phases), 6))
    for row, phase in zip(force, phases, strict=True):
        wet = wet_part(member.start, member.end, wave, phase)
        if wet is not None:
            row[:] = member_force(member.section, *wet, lambda places, now=phase: wave.flow(places, now), density)
            row[3:] -= np.cross(member.foot, row[:3])
    return force


def wet_part(start, end, wave, phase):
    """Two ends (3,) m of the part of a straight member below the surface, None if the member is dry.

    A member is cut at most once, so the method does not apply to a member in the surface that is longer than half a
    wave.
    """
    from scipy.optimize import brentq

    def over(share):
        place = (start + share * (end - start))[None]
        return place[0, 2] - wave.elevation(place, phase)[0]

    dry = over(0.0) > 0, over(1.0) > 0
    if all(dry):
        return None
    if not any(dry):
        return start, end
    cut = start + brentq(over, 0.0, 1.0) * (end - start)
    return (cut, end) if dry[0] else (start, cut)


def moved(force, about, other):
    """Forces (p, 6) with moments about a point (3,) m, converted to moments about another point"""
    return np.concatenate([force[:, :3], force[:, 3:] + np.cross(about - other, force[:, :3])], axis=1)
