"""A line of a MoorDyn file in motion: what the file says of it, and at rest the file's own equilibrium."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.mooring.formats.moordyn_system import read_moordyn_system
from hakobune.mooring.lines.dynamics.start import start
from hakobune.mooring.lines.dynamics.surroundings import water_arrays
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.parts import LineDynamics, LineType, UniformLine
from hakobune.pipelines.cli import main
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.line_dynamics.moordyn import _type, with_moordyn
from hakobune.pipelines.line_dynamics.parts import line_of
from hakobune.pipelines.line_dynamics.study import read_line_dynamics

MOORDYN = """\
---------------------- LINE TYPES -----------------------------------------------
Name   Diam    Mass/m   EA        BA/-zeta   EI     Cd    Ca    CdAx   CaAx
(-)    (m)     (kg/m)   (N)       (N-s/-)    (N-m2) (-)   (-)   (-)    (-)
chain  0.13    110.0    4.9e8     -0.8       0      1.3   1.0   0.2    0.5
rope   0.12    13.0     6.0e7     2.0e5      10     1.2   1.0   0.1    0.0
----------------------- POINTS ------------------------------------------------
ID   Attachment  X       Y       Z       Mass    Volume  CdA    Ca
(#)  (-)         (m)     (m)     (m)     (kg)    (m^3)   (m^2)  (-)
1    Fixed       -290    0       -70     0       0       0      0
2    Free        -60     0       -30     2500    0.4     1.5    0.5
3    Coupled     -20     0       -4      0       0       0      0
----------------------- LINES -------------------------------------------------
ID   LineType  AttachA  AttachB  UnstrLen  NumSegs  LineOutputs
(#)  (name)    (#)      (#)      (m)       (-)      (-)
1    chain     1        2        235.0     40       p
2    rope      3        2        52        20       -
----------------------- OPTIONS -----------------------------------------------
3.0e6    kBot
70       WtrDpth
---------------------- need this line ------------------------------------------
"""
STUDY = """\
duration = 4.0
moordyn = { file = "lines.txt", line = "1" }
[[fairlead.motions]]
amplitude = [0.5, 0.0, 0.2]
period = 2.0
"""


@pytest.fixture
def study(tmp_path):
    (tmp_path / "lines.txt").write_text(MOORDYN)
    (tmp_path / "run.toml").write_text(STUDY)
    return tmp_path / "run.toml"


@pytest.mark.parametrize("number", ["1", "2"])
def test_a_line_of_a_file_goes_through_its_free_points_to_the_anchor_and_rests_as_the_file_does(study, number):
    study.write_text(STUDY.replace('"1"', f'"{number}"'))
    made = with_moordyn(read_line_dynamics(study)[0], study.parent)
    line, _ = line_of(made)
    rope = line.segments[1]
    assert (line.anchor, made.fairlead.position) == ((-290.0, 0.0, -70.0), (-20.0, 0.0, -4.0))
    assert [(s.length, s.elements, s.drag_normal) for s in line.segments] == [(235.0, 40, 1.3), (52.0, 20, 1.2)]
    assert line.segments[0].damping_ratio == 0.8 and np.isclose(rope.damping, 2e5)
    assert (line.segments[0].bending_stiffness, rope.bending_stiffness) == (0.0, 10.0)
    assert line.bodies[0].mass == 2500 and line.bodies[0].drag_area == 1.5 and line.bed.stiffness == 3e6
    with pytest.warns(UserWarning, match="EI"):
        found = rest(read_moordyn_system(study.parent / "lines.txt"))
    still = start(line, made.fairlead.position, water_arrays(None, None, line.gravity)).position
    joint = found.pose.free[0]
    assert np.abs(still[40] - joint).max() < 2e-3 * line.length


def test_the_number_of_a_line_may_be_written_as_a_number(study):
    made = []
    for number in ('"2"', "2"):
        study.write_text(STUDY.replace('"1"', number))
        made.append(with_moordyn(read_line_dynamics(study)[0], study.parent))
    assert made[0].segments == made[1].segments and made[0].anchor == made[1].anchor
    study.write_text(STUDY.replace('"1"', "7"))
    with pytest.raises(ValueError, match=r"moordyn\.line is '7'; allowed: 1, 2"):
        with_moordyn(read_line_dynamics(study)[0], study.parent)


def test_the_command_runs_a_line_of_a_file_and_names_what_is_left_out(study, capsys):
    (study.parent / "lines.txt").write_text(MOORDYN.replace("2.0e5      10 ", "2.0e5      EI.txt "))
    assert main(["line-dynamics", str(study)]) == 1  # largest tensions are not known to 2 %
    shown = capsys.readouterr().out
    assert "largest, quasi-static" in shown and "bending stiffness EI of rope is not included, a table" in shown


def test_a_line_of_a_file_that_comes_out_of_the_water_weighs_as_in_air_there(study):
    (study.parent / "lines.txt").write_text(MOORDYN.replace("-20     0       -4 ", "-20     0        9 "))
    made = with_moordyn(read_line_dynamics(study)[0], study.parent)
    assert made.surface and line_of(made)[0].surface
    study.write_text("surface = false\n" + STUDY)
    assert not with_moordyn(read_line_dynamics(study)[0], study.parent).surface


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"1"', '"7"', "moordyn.line is '7'; allowed: 1, 2"),
        ("duration", "anchor = [0, 0, 0]\nduration", "moordyn and anchor are both given; give one of them"),
        ('moordyn = { file = "lines.txt", line = "1" }', "", "water is missing; give water, types"),
    ],
)
def test_a_line_that_is_not_there_or_is_given_twice_is_refused_by_name(study, capsys, old, new, message):
    study.write_text(STUDY.replace(old, new))
    assert main(["line-dynamics", str(study)]) == 2
    assert message in capsys.readouterr().err


def test_a_rope_with_a_table_is_not_moved_as_if_it_had_none(study, capsys):
    (study.parent / "lines.txt").write_text(MOORDYN.replace("6.0e7 ", "rope.txt "))
    (study.parent / "rope.txt").write_text("rope\nstrain tension\n(-) (N)\n0 0\n0.01 4e5\n0.02 1e6\n")
    assert main(["line-dynamics", str(study)]) == 2
    assert "EA of line 2 is a table or a Syrope rope; allowed in motion: a number" in capsys.readouterr().err


@pytest.mark.parametrize("load, kilonewtons", [(2.5e6, 2500.0), (np.inf, None)])
def test_a_type_of_a_file_is_a_table_of_a_study_in_kilonewtons(load, kilonewtons):
    """EA 4e8 N, EI 3e4 N m²; damping of −0.6 is 0.6 of critical, BA of 2e5 N s that over ℓ √(EA m), ℓ = 10 m"""
    own = LineDynamics(1.1, 0.2, 0.9, 0.1, -0.6, 3e4)
    kind = LineType("chain", 1500.0, 4e8, 190.0, 0.18, load, dynamics=own)
    made = _type(UniformLine("one", kind, 200.0, "a", "b", elements=20), "lines.txt")
    assert (made.axial_stiffness_kN, made.bending_stiffness_kN_m2, made.breaking_load_kN) == (4e5, 30.0, kilonewtons)
    assert (made.weight_N_per_m, made.mass_kg_per_m, made.diameter, made.damping_ratio) == (1500.0, 190.0, 0.18, 0.6)
    assert (made.drag_normal, made.drag_tangential, made.added_normal, made.added_tangential) == (1.1, 0.2, 0.9, 0.1)
    damped = replace(kind, dynamics=replace(own, damping=2e5))
    made = _type(UniformLine("one", damped, 200.0, "a", "b", elements=20), "lines.txt")
    assert made.damping_ratio == pytest.approx(2e5 / (10 * np.sqrt(4e8 * 190)))
    for more, says in (({"mass": 0.0}, "mass of line type chain is 0"),
                       ({"axial_stiffness": np.inf}, "EA of line type"),
                       ({"weight": -1.0}, "in water is -1 N/m; allowed: above 0")):  # fmt: skip
        with pytest.raises(StudyError, match=says):
            _type(UniformLine("one", replace(kind, **more), 200.0, "a", "b"), "lines.txt")


@pytest.mark.parametrize("given, elements", [(0, 4), (3, 4), (4, 4), (7, 7)])
def test_a_line_of_a_file_has_at_least_four_elements(study, given, elements):
    """Those of the file; of one that gives none, or fewer, four"""
    text = (study.parent / "lines.txt").read_text()
    row = "2    rope      3        2        52        20 "
    assert row in text
    (study.parent / "lines.txt").write_text(text.replace(row, row.replace("20 ", f"{given} ")))
    made = with_moordyn(read_line_dynamics(study)[0], study.parent)
    assert [segment.elements for segment in made.segments] == [40, elements]
