"""`hakobune.passing`: the largest surge, sway and yaw of a passage, and the forces over time."""

from __future__ import annotations

import math

import numpy as np

from hakobune.bem.modes import words_of
from hakobune.meshing.files import read_mesh
from hakobune.meshing.mirror import folded
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.environment.spectra import GRAVITY
from hakobune.mooring.passing import by_tests
from hakobune.mooring.passing.passage import FAR, SQUEEZED, along_track
from hakobune.mooring.passing.slender import Slender, wang

from ..common.bounds import Pace
from ..common.quantities import StudyError
from ..printing.number import significant
from ..results.given import File, Tables, given
from ..results.provenance import provenance
from ..results.quantity import quantities
from ..results.result import Result, labels
from ..solve.panel_counts import meshed
from .study import SHIPS, PassingStudy, check_apart, make_study, read_study, size, track_of

BROKEN = 1.5  # 1/√(1 − Fₕ²) above which linear theory gives no estimate
LARGEST = {"surge": 0, "sway": 1, "yaw": 5}
UNITS = ("N", "N", "N", "N m", "N m", "N m")
MOST = 4  # largest number of panels of a mesh file over the requested one
FINE = 6  # factor on the number of places where they cost little


def passing(study: File | Tables | PassingStudy) -> Result:
    """Forces on a moored ship while another ship passes on a parallel track.

    study : path of a study, its tables as a dictionary, or a `study.PassingStudy`
    returns : Result, in SI; its `detail` is the `mooring.passing.passage.Passage`
    raises : ValueError, with a message of one line
    """
    from hakobune.mooring.passing.double_body import double_body, largest_section

    study, text = given(study, PassingStudy, read_study, make_study)
    track, water = track_of(study), study.water
    hulls, middles = zip(*(_hull(study, name) for name in SHIPS), strict=True)
    sizes = np.array([size(getattr(study, name), hull) for name, hull in zip(SHIPS, hulls, strict=True)])
    lengths, beams = sizes[:, 0], sizes[:, 1]
    gap = check_apart(study, beams)
    if not track.froude(water.depth) < 1:
        raise StudyError(
            f"the passing ship moves at {track.through_water:.3g} m/s through water of {water.depth:g} m depth, "
            f"faster than long waves there, {math.sqrt(GRAVITY * water.depth):.3g} m/s; allowed: less"
        )
    fine = 1 if study.method == "panels" else FINE
    places = along_track(track, lengths[0], lengths[1], study.track.lengths, fine)
    moored, passer = (Slender(length, largest_section(hull)) for length, hull in zip(lengths, hulls, strict=True))
    if study.method == "panels":
        found = double_body(
            hulls, track, places, water.depth, wall=study.wall, density=water.density, each=_with_progress
        )
    elif study.method == "wang":
        found = wang(moored, passer, track, places, water.depth, water.density)
    else:
        factors = by_tests.depth_factors(sizes[0, 2], water.depth, gap, beams.mean())
        found = by_tests.kriebel(
            moored, passer, track, places, factors, quay=study.quay, peaks=study.peaks, density=water.density
        )
    center = np.array(study.moored.rotation_center or (0.0, 0.0, 0.0))
    found = found.about((center - middles[0]) * (1, 1, study.method == "panels"))  # the other methods have no height
    axes = labels("motion", list(LARGEST)) | labels("time", found.in_time.times, "s")
    axes |= labels("of_force", list(words_of(())))
    return Result(
        "passing",
        {**_largest(found), **_course(found)},
        axes,
        tuple(_findings(study, track, found, moored, passer)),
        tuple(_notes(study, track, gap)),
        provenance=provenance(text),
        detail=found,
    )


def _hull(study, name):
    """A whole hull with the middle of its waterline at the origin, and that middle (3,) m in its own coordinates"""
    body = getattr(study, name)
    if body.shape != "mesh":
        return meshed(body, None, panels=study.panels).whole(), np.zeros(3)
    hull = folded(read_mesh(body.file)).whole()
    if len(hull) > MOST * study.panels:
        raise StudyError(
            f"{body.file} has {len(hull)} panels; allowed: up to {MOST * study.panels}, which is {MOST} times the "
            "key panels"
        )
    if hull.draft >= study.water.depth:
        raise StudyError(
            f"{body.file} has a draft of {hull.draft:g} m in water of {study.water.depth:g} m; allowed: less"
        )
    low, high = hull.points[:, :2].min(axis=0), hull.points[:, :2].max(axis=0)
    x, y = 0.5 * (low + high)
    return hull.moved(dx=-x, dy=-y), np.array([x, y, 0.0])


def _with_progress(at, places):
    pace = Pace(f"{len(places)} positions of two hulls take", len(places), "give fewer panels, or a shorter track")
    for place in places:
        yield at(place)
        pace.step()


def _largest(found):
    columns = list(LARGEST.values())
    force = found.force[:, columns]
    place, each = np.abs(force).argmax(axis=0), np.arange(3)
    size = np.abs(force).max(axis=0)
    steady = np.abs(found.steady[:, columns]).max(axis=0) / np.where(size > 0, size, np.inf)
    units = tuple(UNITS[column] for column in columns)
    return quantities("largest while the ship passes", {
        "largest.force": (force[place, each], units, "force"),
        "largest.stagger": (found.stagger[place], "m", "passing ship ahead by"),
        "largest.lowest": (force.min(axis=0), units, "lowest"),
        "largest.highest": (force.max(axis=0), units, "highest"),
        "largest.steady": (steady, "%", "part of it from the square of the flow speed"),
    }, "motion")  # fmt: skip


def _course(found):
    table = found.in_time
    way = slice(None, None, -1) if found.track.opposite else slice(None)
    stagger, force = (found.stagger[way], "m", "stagger"), (table.force.T, UNITS, "force on the moored ship")
    return quantities("", {"course.stagger": stagger}, "time", record=True) | quantities(
        "", {"course.force": force}, "of_force", "time", record=True
    )


def _findings(study, track, found, moored, passer):
    froude = track.froude(study.water.depth)
    squeezed = 1 / math.sqrt(1 - froude**2)
    if squeezed > SQUEEZED:
        line = f"depth Froude number {froude:.2f}: the pressure is about {squeezed:.2f} times as large as "
        if study.method == "kriebel":
            line += (
                "by the square of the speed, with which the formula of the tests grows in every depth, limit "
                f"{SQUEEZED:g}; give a lower speed"
            )
        else:
            line += (
                f"with the rigid surface of this method, limit {SQUEEZED:g}; the ship's own waves are not included "
                "either"
            )
        yield fails(line) if squeezed > BROKEN else line
    if found.left > FAR:
        yield (
            f"{100 * found.left:.3g} % of the largest force remains at the ends of the track, limit {100 * FAR:g} %; "
            "raise track.lengths"
        )
    if study.method == "kriebel":
        yield from by_tests.beyond(moored, passer, track)
    if study.method == "wang" and study.moored.shape != "mesh" and study.moored.draft > 0.5 * study.water.depth:
        yield (
            f"the moored ship blocks {100 * study.moored.draft / study.water.depth:.0f} % of the depth, which "
            f"slender-ship theory "
            'does not include; method = "panels" does'
        )


def _notes(study, track, gap):
    if study.method == "panels":
        yield (
            f"both hulls lie under a rigid surface and have about {study.panels} panels each; the result has all "
            "six force components"
        )
    else:
        yield "both ships are slender with parabolic section areas; the result has surge, sway and yaw only"
    about = ", ".join(map(significant, study.moored.rotation_center or (0.0, 0.0, 0.0)))
    yield (
        f"the ship moves at {significant(track.through_water)} m/s through the water, with {significant(gap)} m "
        f"between the sides; the depth Froude number is {track.froude(study.water.depth):.2f}"
    )
    yield (
        "forces are along x to the bow and y to port of the moored ship; moments are about its rotation_center "
        f"[{about}]"
    )
