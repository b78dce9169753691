"""The result of `pipelines.sections.study`: waves, motions and hinge forces, over the frequency."""

from itertools import pairwise

import numpy as np

from hakobune.bem.sections.linked import Floating, Hinge, linked_sections
from hakobune.bem.sections.outline import rectangle

from ..common.bounds import Pace
from ..common.quantities import StudyError
from ..results.given import given
from ..results.provenance import provenance
from ..results.quantity import quantities
from ..results.result import Result, labels
from .study import SectionsStudy, make_study, read_study

MOTIONS, UNITS = ("sway", "heave", "roll"), ("m/m", "m/m", "rad/m")


def side_by_side(study):
    """Result of sections side by side in beam waves; study, raises as in `pipelines.sections.result.sections`"""
    study, text = given(study, SectionsStudy, read_study, make_study)
    order = sorted(study.sections, key=lambda one: one.y)
    names = [one.name for one in order]
    found = _solved(study, order)
    axes = labels("omega", study.omegas, "rad/s") | labels("section", names) | labels("motion", list(MOTIONS))
    made = _of_waves(found)
    if len(names) > 1:
        axes |= labels("gap", [f"{a} and {b}" for a, b in pairwise(names)])
        made |= _of_gaps(found)
    made |= _of_motions(found, order)
    if study.hinges:
        axes |= labels("hinge", [f"{a} and {b}" for a, b in (one.sections for one in study.hinges)])
        made |= _of_hinges(found, any(one.kind == "rigid" for one in study.hinges))
    note = "two dimensions, ideal fluid, waves towards +y; motions are those of a wave of 1 m"
    return Result("sections", made, axes, notes=(note,), provenance=provenance(text), detail=found)


def _solved(study, order):
    """A `bem.sections.linked` solution for each frequency, of the sections from the lee side on"""
    names, sections = [one.name for one in order], [_floating(one) for one in order]
    hinges = [Hinge(tuple(map(names.index, one.sections)), *one.position, one.kind) for one in study.hinges]
    water = {"density": study.water.density, "gravity": study.water.gravity}
    pace = Pace(f"{len(study.omegas)} frequencies take", len(study.omegas), "give fewer omegas")
    found = []
    for omega in study.omegas:
        try:
            found.append(linked_sections(sections, study.water.depth, omega, hinges, study.damping, **water))
        except ValueError as error:
            raise StudyError(str(error)) from None
        pace.step()
    return found


def _of_waves(found):
    waves = {
        "waves.transmission": (np.abs([one.transmission for one in found]), "", "transmission"),
        "waves.reflection": (np.abs([one.reflection for one in found]), "", "reflection"),
        "waves.taken": ([one.taken for one in found], "%", "share of the energy that gaps absorb"),
    }
    return quantities("waves over that of 1 m", waves, "omega")


def _of_gaps(found):
    gains = {"gap.gain": (np.array([one.gains for one in found]).T, "", "gain")}
    return quantities("rise of the water in gaps, per wave amplitude", gains, "gap", "omega")


def _of_motions(found, order):
    motions, made = np.abs([one.motions for one in found]), {}
    for i, one in enumerate(order):
        if not one.fixed:
            values = {f"{one.name}.motion": (motions[:, i].T, UNITS, "motion")}
            made |= quantities(f"motions of {one.name} about its centre of gravity", values, "motion", "omega")
    return made


def _of_hinges(found, rigid):
    """rigid : whether a joint carries moments too"""
    held, made = np.abs([one.held for one in found]), {}
    for i, part in enumerate(MOTIONS if rigid else MOTIONS[:2]):
        unit = "N m/m" if part == "roll" else "N/m"
        values = {f"hinge.{part}": (held[:, :, i].T, unit, f"loads on fixed {part}, per metre")}
        words = f"loads of hinges on {part}, per metre of length and of wave amplitude"
        made |= quantities(words, values, "hinge", "omega")
    return made


def _floating(one):
    wetted = rectangle(one.beam, 2 * one.draft).wetted(one.draft)
    gyration = one.gyration or float(np.hypot(one.beam, one.draft)) / 12**0.5
    return Floating(wetted, one.y, one.mass, one.center_of_gravity, gyration, one.fixed)
