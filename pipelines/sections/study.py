"""Sections side by side in beam waves, free or hinged, as typed TOML.

omegas = [0.5]       [water]            [[sections]]        [[hinges]]
                     depth = 12.0       name = "left"       sections = ["left", "right"]
                                        beam = 30.0         position = [0.0, 0.0]
                                        draft = 6.0
                                        y = -16.5
"""

import math

import msgspec

from hakobune.bem.problem import check_gap
from hakobune.bem.sections.linked import KINDS

from ..common.quantities import StudyError, Table, positive, water_density
from ..common.typed import read_toml, typed
from ..common.weather.water import WaterTable

MOST = 20  # sections
MOST_FREQUENCIES = 1000
DAMPING = 10.0


class SectionTable(Table):
    """A rectangular section, long across the waves

    name : name of the section in the names of its motions
    beam : m, beam of the section
    draft : m, draft of the section
    y : m, y of the middle of the section
    mass : kg/m, mass for each metre of length; by default the mass of the displaced water
    center_of_gravity : m, z of the centre of gravity, positive above still water
    gyration : m, radius of gyration about the centre of gravity; by default the radius of a solid rectangle of this
        beam and draft
    fixed : whether the section scatters waves without moving
    """

    name: str
    beam: float
    draft: float
    y: float
    mass: float | None = None
    center_of_gravity: float = 0.0
    gyration: float | None = None
    fixed: bool = False


class SectionHinge(Table):
    """A link between two sections

    sections : names of the two sections
    position : m, y and z of the hinge
    kind : kind of link: hinge or rigid
    """

    sections: tuple[str, str]
    position: tuple[float, float]
    kind: str = "hinge"


class SectionsStudy(Table):
    """Sections side by side in beam waves that travel towards +y

    omegas : rad/s, wave frequencies
    sections : rectangular sections side by side
    hinges : links between sections
    damping : damping ε of the water in all gaps, 0.02 to 0.07 in model tests
    """

    water: WaterTable
    omegas: list[float]
    sections: list[SectionTable]
    hinges: list[SectionHinge] = msgspec.field(default_factory=list)
    damping: float = 0.0


def read_study(path):
    """The SectionsStudy of a TOML file, and the text of the file.  Raises StudyError."""
    raw, text = read_toml(path, "a study of sections", StudyError)
    return make_study(raw), text


def make_study(raw):
    """The SectionsStudy of nested dictionaries.  Raises StudyError."""
    study = typed(raw, SectionsStudy, StudyError)
    for key in ("depth", "gravity"):
        positive(f"water.{key}", getattr(study.water, key))
    water_density("water.density", study.water.density)
    if not 1 <= len(study.omegas) <= MOST_FREQUENCIES or sorted(set(study.omegas)) != list(study.omegas):
        raise StudyError(f"omegas has {len(study.omegas)} values; allowed: 1 to {MOST_FREQUENCIES}, rising")
    for value in study.omegas:
        positive("omegas", value)
    if not 0 <= study.damping <= DAMPING:
        raise StudyError(f"damping is {study.damping:g}; allowed: 0 to {DAMPING:g}")
    if not 1 <= len(study.sections) <= MOST:
        raise StudyError(f"sections has {len(study.sections)} entries; allowed: 1 to {MOST}")
    for i, one in enumerate(study.sections):
        _check_section(f"sections[{i}]", one, study.water.depth)
    names = [one.name for one in study.sections]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise StudyError(f"two sections have the name {twice!r}; give each section its own name")
    for i, hinge in enumerate(study.hinges):
        _check_hinge(f"hinges[{i}]", hinge, names)
    return study


def _check_section(key, one, depth):
    for name in ("beam", "draft", "mass", "gyration"):
        if getattr(one, name) is not None:
            positive(f"{key}.{name}", getattr(one, name))
    if not one.draft < depth:
        raise StudyError(f"{key}.draft is {one.draft:g} m in water {depth:g} m deep; allowed: below the depth")
    try:
        check_gap(one.draft, depth)
    except ValueError as error:
        raise StudyError(f"{key}: {error}") from None
    for name in ("y", "center_of_gravity"):
        if not math.isfinite(getattr(one, name)):
            raise StudyError(f"{key}.{name} is {getattr(one, name)}; allowed: finite, m")


def _check_hinge(key, hinge, names):
    unknown = [name for name in hinge.sections if name not in names]
    if unknown:
        raise StudyError(f"{key}.sections has {unknown[0]!r}; allowed: {', '.join(names)}")
    if hinge.sections[0] == hinge.sections[1]:
        raise StudyError(f"{key} joins {hinge.sections[0]} to itself; allowed: two different sections")
    if hinge.kind not in KINDS:
        raise StudyError(f"{key}.kind is {hinge.kind!r}; allowed: {', '.join(KINDS)}")
    if not all(map(math.isfinite, hinge.position)):
        raise StudyError(f"{key}.position is {list(hinge.position)}; allowed: finite, m")
