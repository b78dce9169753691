"""What parts of moorings may be, from both sides of each limit, with what is said beyond it."""

import math

import numpy as np
import pytest

from hakobune.mooring.criteria.rules import RuleError, of_rule
from hakobune.mooring.criteria.strength import equipment_number
from hakobune.mooring.downtime.clock import _offsets
from hakobune.mooring.environment.logger_files import read_table
from hakobune.mooring.environment.spectrum_estimate import estimate
from hakobune.mooring.environment.spreading import Mitsuyasu
from hakobune.mooring.environment.tables import TableError
from hakobune.mooring.fenders.fender import FenderError, fender_of_points
from hakobune.mooring.fenders.inclined import inclined
from hakobune.mooring.lines.catalogue import line_type
from hakobune.mooring.lines.catenary.solve import solve_lines, span_at_tension
from hakobune.mooring.lines.dynamics.line import DynamicLine, DynamicSegment
from hakobune.mooring.lines.dynamics.surroundings import FairleadMotion, WaveTrain
from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment
from hakobune.mooring.lines.ropes import RopePart, rope
from hakobune.mooring.lines.system.hawser import Hawser, pull_of_points
from hakobune.mooring.lines.system.parts import LineSystemError, LineType, MooredBody
from hakobune.mooring.loads.box_drag import drag_table
from hakobune.mooring.loads.coefficients import hull_coefficients
from hakobune.mooring.motion.given_forces import read_force
from hakobune.mooring.passing.slender import Slender
from hakobune.mooring.response.long_term import long_term
from hakobune.mooring.seas.two_peaks import torsethaugen
from hakobune.mooring.site.seismic import seismic_coefficient

ERRORS = (ValueError, LineSystemError, RuleError, TableError, FenderError)


def segment(**more):
    return Segment(**{"length": 10.0, "weight": 100.0, "name": "one"} | more)


def dynamic(stiffness):
    return DynamicSegment(100.0, 50.0, 400.0, 0.1, stiffness)


def line(**more):
    return DynamicLine(**{"segments": dynamic(1e8), "anchor": (0.0, 0.0, -20.0)} | more)


def sea(**more):
    return WaveTrain(**{"amplitude": 1.0, "period": 8.0, "direction": 0.0} | more)


def tied(strain=0.2, exponent=1.0, load=1e6, pretension=1e5, hardening=1.0):
    return rope(
        "r", (0.0, 0.0, 0.0), (30.0, 0.0, 0.0), RopePart(load, strain, exponent), pretension, hardening=hardening
    )


def hung(**more):
    return solve_lines(**{"x": 50.0, "z": 20.0, "length": 100.0, "weight": 500.0} | more)


def span(H):
    return span_at_tension(H, 20.0, 100.0, 500.0)


def hull(degrees, y=0.0, last=1.0):
    angle = np.radians(degrees)
    column = np.zeros(len(angle))
    column[-1] = y
    x, n = np.r_[np.ones(len(angle) - 1), last], np.zeros(len(angle))
    return hull_coefficients(angle, x, column, n, area_x=1.0, area_y=1.0, length=1.0)


def box(degrees):
    return drag_table(np.radians(degrees), [1.0, 0.0], [0.0, 1.0])


FENDER = fender_of_points("f", 2.0, [0.0, 0.5, 1.0], [0.0, 5e5, 1e6])
PULL = pull_of_points("r", [0.0, 4.0], [0.0, 4e5])
TWICE = ((0.0, 0.0), (0.1, 1e5), (0.1, 2e5))
RISING = ((0.0, 0.0), (0.1, 1e5), (0.2, 2e5))
NAN3 = (0.0, math.nan, 0.0)
LIMITS = {
    "subject": (lambda word: of_rule(RULES, "x", word), "chain", "rope", "no criterion for 'rope'; allowed: \"chain\""),
    "displacement": (lambda d: equipment_number("NV", d, front=1.0), 1e-9, 0.0, "displacement is 0 t; allowed: above"),
    "endings of times": (lambda ends: _offsets(ends, "f"), ["Z", "+09:00"], ["Z", "9"],
     "different time zones, one of them '9'"),
    "record": (lambda a: estimate(a * np.cos(np.arange(64.0)), 1.0, 16.0), 1e-9, 0.0, "m throughout; give a record"),
    "overlap": (lambda o: estimate(np.cos(np.arange(64.0)), 1.0, 16.0, overlap=o), 0.99, 1.0, "overlap is 1"),
    "frequency of a spreading": (lambda w: Mitsuyasu(10.0, 0.8).density(0.0, w), 0.8, None, "give the frequency omega"),
    "incline": (lambda deg: inclined(FENDER, 2.0, math.radians(deg)), 44.9, 45.1,
     "inclined by 45.1°; allowed: 0 to 45"),
    "incline down": (lambda deg: inclined(FENDER, 2.0, math.radians(deg)), 0.0, -0.1, "inclined by -0.1°; allowed: 0"),
    "wire": (line_type, "wire 6x24 FC G 40 mm", "wire 6x25 FC G 40 mm", "6x24 FC"),
    "word for reach": (lambda w: hung(beyond_reach=w), "mark", "leave",
     "beyond_reach is 'leave'; allowed: 'raise', 'mark'"),
    "height over the bed": (lambda z: hung(z=z), 0.0, -1e-6, "line z is -1e-06; allowed: at or above the bed"),
    "weight of a catenary": (lambda w: hung(weight=w), 1.0, -1.0, "line weight is -1; allowed: "),
    "tension of a span": (span, 1e3, 0.0, "horizontal_tension is 0 N; allowed: finite values above 0"),
    "tension without end": (span, [1e3, 1e4], [1e3, math.inf], "horizontal_tension is inf N; allowed: finite"),
    "strains": (lambda t: dynamic(t).stiffness, RISING, TWICE,
     "a strain twice; allowed: strains that rise from 0"),
    "anchor": (lambda p: line(anchor=p), (1.0, 2.0, 3.0), NAN3, "; allowed: three finite numbers in m"),
    "numbers of an anchor": (lambda p: line(anchor=p), (1.0, 2.0, 3.0), (1.0, 2.0),
     "; allowed: three finite numbers in m"),
    "segments": (lambda s: line(segments=s), (dynamic(1e8),), (), "a line has 0 segments; allowed: 1 or more"),
    "amplitude of a fairlead": (
        lambda a: FairleadMotion.harmonic((0.0, 0.0, 0.0), a, 8.0), (1.0, 0.0, 1j), (1.0, math.inf, 0.0), "finite",
    ),
    "period of a fairlead": (
        lambda T: FairleadMotion.harmonic((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), T), 0.1, 0.0, "period is 0 s; allowed",
    ),
    "place of a fairlead": (
        lambda p: FairleadMotion.harmonic(p, (1.0, 0.0, 0.0), 8.0), (0.0, 0.0, 0.0), NAN3, "fairlead position is",
    ),
    "period of waves": (lambda T: sea(period=T), 0.1, 0.0, "finite arrays of shape (w,), with periods above 0 s"),
    "phase of waves": (lambda p: sea(phase=p), -3.0, math.nan, "must be finite arrays of shape (w,)"),
    "depth of waves": (lambda h: sea(depth=h), 0.1, 0.0, "water depth is 0 m; allowed: above 0, inf for deep water"),
    "length of a segment": (lambda v: segment(length=v), 0.1, 0.0,
     "segment one: length is 0 m; allowed: finite, above 0"),
    "load of a segment": (lambda v: segment(breaking_load=v), 0.1, 0.0, "segment one: breaking_load is 0 N; allowed"),
    "stiffness of a segment": (lambda v: segment(axial_stiffness=v), 0.1, 0.0,
     "axial_stiffness is 0 N; allowed: above"),
    "table of a segment": (
        lambda v: segment(axial_stiffness=v), RISING, RISING[1:], "not a table of (strain, tension); allowed: at least",
    ),
    "tensions of a table": (
        lambda T: segment(axial_stiffness=((0.0, 0.0), (0.1, 1e5), (0.2, T))), 1.01e5, 1e5,
        "not a table of (strain, tension)",
    ),
    "weight of a load": (lambda w: PointLoad(1.0, w, name="b"), -5.0, math.nan,
     "point load b: weight is nan N; allowed"),
    "weight in air": (lambda w: PointLoad(1.0, -5.0, w, "b"), 0.0, -0.1,
     "weight_in_air is -0.1 N; allowed: at least 0"),
    "strain of a rope": (lambda v: tied(strain=v), 1.99, 2.0,
     "strain 2 and exponent 1; allowed: above 0 N, strain 0 to 2, exponent 0.2 to 5"),
    "strain of a stiff rope": (lambda v: tied(strain=v), 1e-3, 0.0, "strain 0 and exponent 1; allowed: above 0 N, "
        "strain 0 to 2"),
    "exponent of a rope": (lambda v: tied(exponent=v), 5.0, 5.1, "exponent 5.1; allowed: above 0 N, strain 0 to 2, "
        "exponent 0.2 to 5"),
    "exponent of a soft rope": (lambda v: tied(exponent=v), 0.2, 0.19, "exponent 0.19; allowed: above 0 N, strain 0 "
        "to 2"),
    "pretension of a rope": (lambda v: tied(pretension=v), 9.9e5, 1e6,
     "pretension is 1000 kN; allowed: below its breaking"),
    "hardening of a rope": (lambda v: tied(hardening=v), 20.0, 20.1, "hardening is 20.1; allowed: 0.2 to 20"),
    "softening of a rope": (lambda v: tied(hardening=v), 0.2, 0.19, "hardening is 0.19; allowed: 0.2 to 20"),
    "load of a hawser": (lambda v: Hawser("h", PULL, 9.0, "a", "b", v), 0.1, 0.0,
     "line h: breaking_load is 0 N; allowed"),
    "length of a hawser": (lambda v: Hawser("h", PULL, v, "a", "b"), 0.1, 0.0, "line h: length is 0; allowed: finite"),
    "stiffness of a type": (lambda v: LineType("t", 1.0, v), 0.1, 0.0, "line type t: axial_stiffness is 0 N; allowed"),
    "weight of a type": (lambda v: LineType("t", v), -1.0, 0.0, "line type t: weight"),
    "place of a body": (
        lambda p: MooredBody("b", p), (0.0,) * 6, (0.0, *NAN3, 0.0, 0.0), "body b: position is",
    ),
    "numbers of a load": (lambda p: MooredBody("b", load=p), (0.0,) * 6, (0.0,) * 5, "allowed: six finite numbers"),
    "angles of a box": (box, [0, 90], [0, 89], "drag coefficient angles end at 89°; allowed: 90°"),
    "angles of a hull": (hull, [0, 60, 120, 180], [0, 60, 120, 170],
     "run from 0° to 170°; allowed: rising, 0 to 180° or 360°"),
    "end of a hull": (lambda y: hull([0, 60, 120, 180], y), 0.0, 0.1,
     "hull coefficient y is 0 at 0°, 0.1 at 180°; allowed: 0"),
    "whole turn of a hull": (lambda x: hull([0, 90, 180, 360], 0.0, x), 1.0, 1.1,
     "at 0° and 360° differ; allowed: the same"),
    "section of a ship": (lambda a: Slender(200.0, a), 0.1, 0.0, "the section area 0.0 m²; allowed: positive, finite"),
    "length of a ship": (lambda a: Slender(a, 9.0), 0.1, math.inf, "length is inf m and the section area 9.0 m²"),
    "shares of states": (lambda p: long_term([1.0, 1.0], [1.0, 1.0], [0.5, p]), 0.5, 0.51, "sum to 1.01, least 0.5"),
    "share below 0": (lambda p: long_term([1.0, 1.0], [1.0, 1.0], [0.5, p]), 0.0, -0.1, "sum to 0.4, least -0.1"),
    "as many shares": (
        lambda n: long_term([1.0, 1.0], [1.0] * n, [0.5, 0.5]), 2, 1, "moments and shares have 2, 1, 2 values; allowed",
    ),
    "period of two peaks": (lambda T: torsethaugen(4.0, peak_period=T), 10.0, None, "torsethaugen: no period is given"),
    "long period of two peaks": (lambda T: torsethaugen(4.0, peak_period=T), 25.0, 25.1, "peak period of torsethaugen"),
    "steepness of two peaks": (lambda T: torsethaugen(4.0, peak_period=T), 6.0, 3.9, "peak period of torsethaugen"),
    "rule of an earthquake": (
        lambda rule: seismic_coefficient(rule, regional=0.1, ground=1.0, importance=1.0), "F", "B",
        "rule is 'B'; allowed",
    ),
    "factors of an earthquake": (
        lambda names: seismic_coefficient("F", **dict.fromkeys(names, 1.0)), ("regional", "ground", "importance"),
        ("regional", "ground"), "factors of rule F are regional, ground; allowed: regional, ground, importance",
    ),
}  # fmt: skip


class Rule:
    rule, subject = "X", "chain"


RULES = (Rule,)


@pytest.mark.parametrize("name", LIMITS)
def test_parts_are_taken_up_to_their_limits_and_refused_beyond(name):
    make, good, bad, says = LIMITS[name]
    make(good)
    with pytest.raises(ERRORS) as refused:
        make(bad)
    assert says in str(refused.value)


@pytest.mark.parametrize("row, says", [
    ("1,2,3", None), ("1,2", "line 3 has 2 columns; allowed: 3, as in the first line"), ("1,2,x", "line 3"),
])  # fmt: skip
def test_rows_of_a_table_have_as_many_numbers_as_the_first(row, says, tmp_path):
    path = tmp_path / "table.csv"
    path.write_text(f"a,b,c\n1,2,3\n{row}\n")
    if says is None:
        assert read_table(path)[1].shape == (2, 3)
    else:
        with pytest.raises(TableError) as refused:
            read_table(path)
        assert says in str(refused.value)


def test_columns_of_a_force_are_called_by_their_names(tmp_path):
    path = tmp_path / "tug.csv"
    path.write_text("t,Fx,Fy,Fz,Mx,My,Mz\n0,1,2,3,4,5,6\n1,1,2,3,4,5,6\n")
    read_force(path)
    for head, says in (("t,Fx,Fy,Fz,Mx,My,M\n", "has the columns t, Fx, Fy, Fz, Mx, My, M; allowed: t, Fx"),
                       ("", "has no column names in its first row; allowed: t, Fx")):  # fmt: skip
        path.write_text(head + "0,1,2,3,4,5,6\n1,1,2,3,4,5,6\n")
        with pytest.raises(TableError) as refused:
            read_force(path)
        assert says in str(refused.value)
