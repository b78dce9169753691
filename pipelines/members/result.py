"""`hakobune.members`: forces on slender members over one wave: largest force on each member and on all members, and
their phases.
"""

from __future__ import annotations

import numpy as np

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.loads.over_wave import moved, over_wave

from ..common.bounds import told
from ..printing.number import significant
from ..results.given import File, Tables, given
from ..results.provenance import provenance
from ..results.quantity import quantities
from ..results.result import Result, labels
from .study import MembersStudy, make_study, placed, read_study, wave_of, wind_on

PHASES = 360  # phases of a wave
SLENDER = 0.2  # D/λ above which a member scatters the wave
IN_WATER, ALL = "all in the water", "all"
A_MEMBER = 0.1  # s, over a wave


def members(study: File | Tables | MembersStudy) -> Result:
    """Forces of water and wind on slender members over a regular wave: piles and frames of a dolphin, cranes.

    study : path of a study of members, its tables as a dictionary, or a `study.MembersStudy`
    returns : Result, in SI
    raises : ValueError, with a message of one line
    """
    study, text = given(study, MembersStudy, read_study, make_study)
    wave, wind, standing = wave_of(study), wind_on(study), placed(study)
    phases = np.linspace(0.0, 2 * np.pi, PHASES if wave.amplitude else 1, endpoint=False)
    told(f"{len(standing)} members take", A_MEMBER * len(standing))
    rows = _rows(standing, wind, wave, phases, study.water.density)
    force = np.stack([one for _, _, one in rows], axis=1)
    axes = labels("member", [name for name, _, _ in rows]) | labels("phase", phases, "rad") | labels("xyz", list("xyz"))
    return Result(
        "members",
        {**_largest(force, phases, wave.amplitude > 0), **_records(rows, force)},
        axes,
        tuple(findings(standing, force, wave)),
        tuple(_notes(wave)),
        provenance=provenance(text),
    )


def _rows(standing, wind, wave, phases, density):
    """[(name, (3,) m that moments are about, (p, 6) N and N m)] of members, all in the water, the wind, and all"""
    bed = np.array([0.0, 0.0, -wave.depth])
    wet = [(one.name, one.foot, over_wave(one, wave, phases, density)) for one in standing]
    blown = [moved(force[None], np.zeros(3), bed) * np.ones((len(phases), 1)) for _, force in wind]
    together = sum((moved(force, foot, bed) for _, foot, force in wet), np.zeros((len(phases), 6)))
    rows = [*wet, *([(IN_WATER, bed, together)] if wet else [])]
    rows += [(f"{name}, wind", bed, force) for (name, _), force in zip(wind, blown, strict=True)]
    return rows + ([(ALL, bed, together + sum(blown))] if wet and wind else [])


def _largest(force, phases, waves):
    """For forces (p, m, 6): the largest force and the largest moment of each, and their phases, nan for steady ones"""
    size, turning = (np.linalg.norm(part, axis=2) for part in (force[..., :3], force[..., 3:]))
    i, j, each = size.argmax(axis=0), turning.argmax(axis=0), np.arange(force.shape[1])
    steady = np.all(force == force[0], axis=(0, 2))
    columns = {"force.size": (size[i, each], "N", "force")}
    if waves:
        columns["force.phase"] = np.where(steady, np.nan, phases[i]), "rad", "at phase"
    columns |= {f"force.{name}": (force[i, each, k], "N", name) for k, name in enumerate(("Fx", "Fy", "Fz"))}
    columns["moment.size"] = turning[j, each], "N m", "moment"
    if waves:
        columns["moment.phase"] = np.where(steady, np.nan, phases[j]), "rad", "at phase"
    return quantities("largest over the wave" if waves else "in the current", columns, "member")


def _records(rows, force):
    about = {"about": (np.array([place for _, place, _ in rows]), "m", "reference point of moments")}
    series = {"course.force": (force[..., :3], "N", "force"), "course.moment": (force[..., 3:], "N m", "moment")}
    return quantities("", about, "member", "xyz") | quantities("", series, "phase", "member", "xyz", record=True)


def findings(standing, force, wave):
    """Findings, one line each, on members that are never wet or too wide for Morison's formula; force : (p, m, 6)"""
    dry = [one.name for k, one in enumerate(standing) if not force[:, k].any()]
    if dry:
        yield (
            f"{', '.join(dry)}: no force, since a member there is never in the water; z is measured upwards from "
            "still water"
        )
    length = 2 * np.pi / wave.k
    wide = [one for one in standing if wave.amplitude > 0 and one.section.width > SLENDER * length]
    if wide:
        widest = max(one.section.width for one in wide)
        yield fails(
            f"{', '.join(one.name for one in wide)}: the width is {widest:.3g} m, limit {SLENDER:g} of the "
            f"wave length, {length:.3g} m; such a member scatters the wave: solve it with hakobune box or buoy"
        )


def _notes(wave):
    if wave.amplitude > 0:
        alone = ""
        if wave.current is not None:
            met = f"a fixed point meets a crest every {significant(wave.met_period)} s"
            alone = f" in water that moves with the current; {met}"
        yield (
            f"the wave is {significant(2 * wave.amplitude)} m high and {significant(2 * np.pi / wave.k)} m "
            f"long{alone}; the theory is linear, stretched to the surface (Wheeler); at phase 0 the crest is at the "
            "origin"
        )
    yield "moments are about the foot of each member; totals and wind are about the bed under the origin"
