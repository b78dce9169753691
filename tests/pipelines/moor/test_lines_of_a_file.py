"""Lines of a study from a file of MoorDyn: the numbers of the file, where the body has its fairleads."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.motion.moving_lines.prepare import dynamic_line
from hakobune.mooring.motion.simulation import able_to_move
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.line_dynamics.moordyn import with_moordyn
from hakobune.pipelines.line_dynamics.parts import line_of as dynamic_alone
from hakobune.pipelines.line_dynamics.study import make_line_dynamics
from hakobune.pipelines.moor.study import read_study

FILE = """--- LINE TYPES ---
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
chain 0.1 100.0 5.0e8 -1.0 0.0 1.3 1.0 0.2 0.5
wire 0.05 20.0 2.0e8 -1.0 0.0 1.3 1.0 0.2 0.5
--- BODIES ---
ID Attachment X0 Y0 Z0 r0 p0 y0 Mass CG I Volume CdA Ca
(#) (-) (m) (m) (m) (deg) (deg) (deg) (kg) (m) (kg-m^2) (m^3) (m^2) (-)
1 Coupled 0 0 0 0 0 90 0 0 0 0 0 0
--- POINTS ---
ID Type X Y Z M V CdA Ca
(#) (name) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed 0.0 290.0 -50.0 0 0 0 0
2 Body1 20.0 5.0 -4.0 0 0 0 0
3 Free 0.0 100.0 -40.0 0 0 0 0
4 Body1 -20.0 0.0 -4.0 0 0 0 0
5 Fixed 0.0 -200.0 -45.0 0 0 0 0
--- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
1 chain 1 3 200.0 20 -
2 wire 3 2 85.0 10 -
3 chain 4 5 190.0 20 -
--- OPTIONS ---
1025 WtrDnsty
50 WtrDpth
9.80665 g
--- OUTPUTS ---
--- end ---
"""
HEAD = 'lines_file = "m.dat"\n[water]\ndepth = 50.0\n[hull]\nlength = 60.0\nbeam = 30.0\ndraft = 8.0\nfreeboard = 5.0\n'


def read(folder, text=HEAD, file=FILE):
    (folder / "m.dat").write_text(file)
    (folder / "s.toml").write_text(text)
    return read_study(folder / "s.toml")


def test_a_buoy_has_the_buoyancy_of_the_water_of_its_file(tmp_path):
    """Whatever the water of the database that the study stands in: (m − 1025 V) g"""
    buoy = FILE.replace("3 Free 0.0 100.0 -40.0 0 0 0 0", "3 Free 0.0 100.0 -20.0 16000 20 0 0")
    study, _ = read(tmp_path, file=buoy)
    for density in (1000.0, 1025.0):
        (load,) = study.system(study.hull_of({}), (0, 0, 0), density, 9.81).lines[0].loads
        assert load.weight == pytest.approx((16000 - 1025 * 20) * 9.80665)


def test_a_line_with_a_buoy_moves_with_what_the_file_says_and_as_driven_alone(tmp_path):
    """Mass, drag, elements and buoy of the file: the line of `line-dynamics` with [moordyn], but for its bed"""
    file = FILE.replace("3 Free 0.0 100.0 -40.0 0 0 0 0", "3 Free 0.0 100.0 -20.0 16000 20 12.5 0.9")
    study, _ = read(tmp_path, file=file.replace("wire 0.05 20.0 2.0e8 -1.0", "wire 0.05 20.0 2.0e8 4.0e5"))
    system = study.system(study.hull_of({}), (0, 0, 0))
    asked = make_line_dynamics({"moordyn": {"file": "m.dat", "line": "2"}, "fairlead": {}})
    alone, _ = dynamic_alone(with_moordyn(asked, tmp_path))
    end = next(point for point in system.points if point.name == system.lines[0].a)
    moving = dynamic_line(system.lines[0], end.position, system, 20)
    left_out = ("bed_stiffness", "bed_damping", "bed_thickness")
    for name, value in alone.system._asdict().items():
        if name not in left_out:
            np.testing.assert_allclose(getattr(moving.system, name), value, rtol=1e-12, atol=1e-12, err_msg=name)
    assert moving.system.body_displaced[20] == pytest.approx(1025 * 20) and moving.elements == 30
    backwards = replace(system.lines[0], a=system.lines[0].b, b=system.lines[0].a,
                        segments=system.lines[0].segments[::-1],
                        loads=[replace(load, position=85.0) for load in system.lines[0].loads])  # fmt: skip
    turned = replace(system, lines=(backwards, system.lines[1]))
    assert dynamic_line(backwards, end.position, turned, 20) == moving
    able, left_out = able_to_move(system, SimpleNamespace(dynamic_elements=20))
    assert able == tuple(system.line_names) and left_out == ()


def test_a_line_with_segments_of_no_known_mass_stays_static_and_its_buoy_is_told(tmp_path):
    study, _ = read(tmp_path, file=FILE.replace("3 Free 0.0 100.0 -40.0 0", "3 Free 0.0 100.0 -40.0 900"))
    system = study.system(study.hull_of({}), (0, 0, 0))
    bare = replace(system.lines[0], segments=[replace(part, kind=None) for part in system.lines[0].segments])
    _, told = able_to_move(replace(system, lines=(bare, system.lines[1])), SimpleNamespace(dynamic_elements=20))
    assert "line 1 2 in static shape" in told[0] and "has no mass" in told[0]
    assert "sinkers and buoys of line 1 2" in told[1] and "tensions are too small" in told[1]
    off = replace(system.lines[0], loads=[replace(load, position=150.0) for load in system.lines[0].loads])
    with pytest.raises(
        ValueError,
        match=(
            "line 1 2 has sinkers or buoys within a segment or two at one joint; allowed: one at each joint of "
            "two segments"
        ),
    ):
        dynamic_line(off, (0.0, 290.0, -50.0), replace(system, lines=(off, system.lines[1])), 20)


def test_breaking_loads_that_a_file_does_not_have_are_given_beside_it(tmp_path):
    text = HEAD + "[types.chain]\nbreaking_load_kN = 4000.0\n[types.wire]\nbreaking_load_tonf = 100.0\n"
    study, laid = read(tmp_path, text)
    joined, chain = study.system(study.hull_of({}), (0, 0, 0)).lines
    assert chain.breaking_load == pytest.approx(4e6)
    assert [part.breaking_load for part in joined.segments] == pytest.approx([4e6, 980665.0])
    assert joined.segments[1].weight == pytest.approx((20.0 - 1025 * math.pi / 4 * 0.05**2) * 9.80665)
    assert "breaking_load_tonf = 100.0" in laid and "lines_file" not in laid


def test_lines_have_the_numbers_of_the_file(tmp_path):
    """Submerged weight (m − ρ π d²/4) g; a body headed 90° has what lies ahead at +y"""
    study, text = read(tmp_path)
    system = study.system(study.hull_of({}), (0, 0, 0))
    joined, chain = system.lines
    assert [part.length for part in joined.segments] == [200.0, 85.0]  # from the anchor up, and at the free joint
    assert joined.segments[1].weight == pytest.approx((20.0 - 1025 * math.pi / 4 * 0.05**2) * 9.80665)
    assert chain.length == 190.0 and chain.type.axial_stiffness == pytest.approx(5e8)
    assert chain.type.weight == pytest.approx((100.0 - 1025 * math.pi / 4 * 0.1**2) * 9.80665)
    places = {one.name: one.position for one in system.points}
    assert places[joined.b] == pytest.approx((-5.0, 20.0, -4.0)) and places[chain.b] == pytest.approx((0, -20, -4))
    assert places[joined.a] == pytest.approx((0, 290, -50)) and places[chain.a] == pytest.approx((0, -200, -45))
    assert "lines_file" not in text and "[types.chain]" in text  # what is kept needs no file


@pytest.mark.parametrize(
    ("text", "file", "said"),
    [
        (HEAD.replace("50.0", "60.0"), FILE, "lines_file: .*WtrDpth is 50 m and the given depth is 60 m"),
        (HEAD + "[types.c]\nbreaking_load_kN = 9.0\n", FILE, "types: m.dat has no type 'c'; allowed: chain, wire"),
        (
            HEAD + "[types.wire]\nweight_N_per_m = 9.0\n",
            FILE,
            "types.wire: weight_N_per_m is given beside lines_file; allowed: breaking_load_kN or breaking_load_tonf",
        ),
        (HEAD + '[[spreads]]\ntype = "c"\n', FILE, "spreads and lines_file are both given"),
        (HEAD, FILE.replace("3 Free", "3 Coupled"), "ends at a joint of 1 lines|bodies; allowed: one"),
        (HEAD.replace("m.dat", "none.dat"), FILE, "lines_file: .*none.dat"),
    ],
)
def test_what_no_study_can_have_is_told_by_its_file(tmp_path, text, file, said):
    with pytest.raises(StudyError, match=said):
        read(tmp_path, text, file)


@pytest.mark.parametrize(("pose", "said"), [
    ("0 0 0 0 0 0", ""), ("0 0 -3 0 0 0", ""),  # a body may have its origin below the waterline
    ("4.5 0 0 0 0 0", "x 4.5 m"), ("0 -2 0 0 0 90", "y -2 m, yaw 90°"),
])  # fmt: skip
def test_a_body_that_a_file_does_not_have_at_rest_is_told_with_its_pose(tmp_path, recwarn, pose, said):
    """Its fairleads are where the file has them: 20 m ahead of it, wherever it stands"""
    study, _ = read(tmp_path, file=FILE.replace("Coupled 0 0 0 0 0 90", f"Coupled {pose}"))
    told = [str(one.message) for one in recwarn if "displaced body" in str(one.message)]
    assert len(told) == bool(said) and all(
        f"its body body 1 at {said}; the fairleads at that place" in line for line in told
    )
    x, *_, yaw = map(float, pose.split())
    turned = (20 * math.cos(math.radians(yaw)) - 5 * math.sin(math.radians(yaw))) + x
    assert study.lines[0].fairlead[0] == pytest.approx(turned, abs=1e-9)
