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
    sections = [_floating(one) for one in order]
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
    axes = labels("omega", study.omegas, "rad/s") | labels("section", names) | labels("motion", list(MOTIONS))
    waves = {
        "waves.transmission": (np.abs([one.transmission for one in found]), "", "transmission"),
        "waves.reflection": (np.abs([one.reflection for one in found]), "", "reflection"),
        "waves.taken": ([one.taken for one in found], "%", "share of the energy that gaps absorb"),
    }
    made = quantities("waves over that of 1 m", waves, "omega")
    if len(names) > 1:
        axes |= labels("gap", [f"{a} and {b}" for a, b in pairwise(names)])
        gains = np.array([one.gains for one in found]).T
        made |= quantities(
            "rise of the water in gaps, per wave amplitude", {"gap.gain": (gains, "", "gain")}, "gap", "omega"
        )
    motions = np.abs([one.motions for one in found])
    for i, name in enumerate(names):
        if not order[i].fixed:
            made |= quantities(f"motions of {name} about its centre of gravity", {
                f"{name}.motion": (motions[:, i].T, UNITS, "motion")}, "motion", "omega")  # fmt: skip
    if hinges:
        axes |= labels("hinge", [f"{a} and {b}" for a, b in (one.sections for one in study.hinges)])
        held = np.abs([one.held for one in found])
        rigid = any(one.kind == "rigid" for one in study.hinges)
        for i, part in enumerate(MOTIONS if rigid else MOTIONS[:2]):
            unit = "N m/m" if part == "roll" else "N/m"
            values = {f"hinge.{part}": (held[:, :, i].T, unit, f"loads on fixed {part}, per metre")}
            made |= quantities(
                f"loads of hinges on {part}, per metre of length and of wave amplitude", values, "hinge", "omega"
            )
    note = "two dimensions, ideal fluid, waves towards +y; motions are those of a wave of 1 m"
    return Result("sections", made, axes, notes=(note,), provenance=provenance(text), detail=found)


def _floating(one):
    wetted = rectangle(one.beam, 2 * one.draft).wetted(one.draft)
    gyration = one.gyration or float(np.hypot(one.beam, one.draft)) / 12**0.5
    return Floating(wetted, one.y, one.mass, one.center_of_gravity, gyration, one.fixed)
