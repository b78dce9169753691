"""The study as a whole: a stand-in database with known numbers, and the command on a file of them."""

import tomllib
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from chain_study import chain_study

from hakobune import pipelines
from hakobune.bem.database import Header, append, append_limit, create, open_database, pending, writing
from hakobune.bem.database.between_frequencies import Between
from hakobune.bem.database.reader import Reader
from hakobune.bem.waves import incident_wave, wavenumber
from hakobune.meshing.panels import PanelMesh
from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.catenary.state import State
from hakobune.mooring.lines.multi_segment.segments import PointLoad, Segment
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.moored_body import corner_legs, moored_body
from hakobune.mooring.lines.system.parts import CompositeLine, LineType, UniformLine
from hakobune.mooring.studies.conditions import Conditions, Current, ExposedBox, Waves, Wind
from hakobune.mooring.studies.multi_point import line_ends, multi_point
from hakobune.mooring.studies.multi_point_findings import resonances
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.units import KNOT, TONF
from hakobune.pipelines.moor.command import moor as command
from hakobune.pipelines.moor.plan_picture import UNKNOWN
from hakobune.pipelines.moor.result import moor as found
from hakobune.pipelines.moor.study import make_study, read_study
from hakobune.pipelines.results.file import read

SCENES = Path(pipelines.__file__).parent / "scenes"
MASS = 51.25e6
INERTIA = MASS * np.diag([1, 1, 1, 15.55**2, 29.44**2, 32.28**2])
STIFFNESS = 1025 * 9.80665 * np.diag([0, 0, 5000, 50000 * 15.83, 50000 * 78.33, 0])
OMEGA = np.array([0.1, 0.3, 2 * np.pi / 10, 0.9])
HEADINGS = np.radians([0.0, 60.0, 240.0, 270.0])
HULL = ExposedBox(100.0, 50.0, 10.0, 10.0)
MADE_UP = {
    "added_mass": np.diag([0.2, 0.5, 2.0, 1.0, 1.0, 0.4]) * INERTIA,
    "radiation_damping": 0.05 * INERTIA,
    "excitation_force": np.array([1e6, 2e6, 5e6, 2e7, 3e7, 1e7]) * np.exp(1j * np.arange(6)),
    "rao": np.array([0.2, 0.4, 0.5, 0.03, 0.015, 0.002]) * np.exp(1j * np.arange(6)),
    "drift_force": np.array([-2e4, -8e4, 1e5]),
}
STUDY = f"""{chain_study([30, 45, 60])}[wind]
speed = 50.0
incidence_deg = 60.0
[current]
speed_knots = 3.0
direction_deg = 240.0
[waves]
height = 4.5
period = 10.0
incidence_deg = 60.0
method = "regular_wave"
"""


HEAD_SEA = "period = 10.0\nincidence_deg = 0.0"


class StandIn:
    """What a study reads of a database, with the numbers above at every frequency and heading."""

    omega, wave_direction = OMEGA, HEADINGS
    water_depth, density, gravity = 20.0, 1025.0, 9.80665
    rotation_center = np.zeros(3)
    inertia_matrix, hydrostatic_stiffness = INERTIA, STIFFNESS
    has_viscous_motions, bodies = False, ()

    @property
    def bodies_reader(self):
        plan = np.array([[50.0, 25.0], [-50.0, 25.0], [-50.0, -25.0], [50.0, -25.0]])
        stored = {name: self[name] for name in MADE_UP}
        between = Between(OMEGA, stored, 20.0, 9.80665, HEADINGS, np.zeros(1), plan)
        return Reader(between, 1025.0, np.zeros(3), INERTIA, STIFFNESS, np.zeros((6, 6)))

    def __getitem__(self, name):
        shape = (len(OMEGA),) if MADE_UP[name].ndim == 2 else (len(OMEGA), len(HEADINGS))
        return np.broadcast_to(MADE_UP[name], shape + MADE_UP[name].shape)


def moor(study, database):
    """MultiPoint of a study"""
    return found(study, database).detail[0]


def spread(length=260.0, **changes):
    kind = LineType("chain", 0.406 * TONF, **{"axial_stiffness": 2.2e5 * TONF, "breaking_load": 1700 * TONF, **changes})
    chain = UniformLine("chain", kind, 260.0, "anchor", "fairlead")
    legs = corner_legs(chain, 100, 50, np.radians([30, 45, 60]), 20.0, 40 * TONF)
    return moored_body([leg._replace(line=replace(leg.line, length=length)) for leg in legs], 20.0)


def storm(**changes):
    to = np.radians(240)
    current = Current(3 * KNOT, to, waves="still")  # motions of the database are made up, and follow from nothing
    steady = Conditions(Wind(50.0, to), current, Waves(4.5, 10.0, to), "regular_wave")
    return replace(steady, **changes)


@pytest.fixture(scope="module")
def stormy():
    return multi_point(StandIn(), spread(), HULL, storm())


@pytest.fixture
def database(tmp_path):
    path = tmp_path / "box.h5"
    mesh = PanelMesh([[0, 0, -1], [0, 1, -1], [1, 1, -1], [1, 0, -1]], [[0, 1, 2, 3]], "xy", "plate")
    body = {"inertia_matrix": INERTIA, "hydrostatic_stiffness": STIFFNESS, "center_of_mass": np.zeros(3)}
    header = Header(
        mesh,
        None,
        20.0,
        1025.0,
        9.80665,
        np.zeros(3),
        np.zeros(1),
        body=body,
        dimensions={"length": 100.0, "beam": 50.0, "draft": 10.0},
    )
    create(path, header, OMEGA, HEADINGS, ("added_mass", "rao", "drift_force", "added_mass_zero"))
    todo = pending(path)
    with writing(path) as file:
        for row in todo.rows:
            result = {
                name: value if value.ndim == 2 else np.broadcast_to(value, (len(row.headings), *value.shape))
                for name, value in MADE_UP.items()
            }
            append(file, row.omega, row.headings, result)
        append_limit(file, "added_mass_zero", MADE_UP["added_mass"])
    return path


def test_tension_is_the_statics_of_the_displaced_fairlead(stormy):
    """Every mode adds its largest displacement, outward and up, for each line by itself."""
    i = int(np.argmax(stormy.tension))
    anchor, fairlead = (points[i] for points in line_ends(stormy.equilibrium))
    arm, away = fairlead - stormy.equilibrium.pose.place[0], (fairlead - anchor)[:2]
    n = away / np.hypot(*away)
    a = np.abs(MADE_UP["rao"]) * 4.5 / 2
    turn = [np.cross(axis, arm) for axis in np.eye(3)]
    out = sum(a[:2] * np.abs(n)) + sum(a[3 + j] * abs(turn[j][:2] @ n) for j in range(3))
    up = a[2] + sum(a[3 + j] * abs(turn[j][2]) for j in range(3))
    line = solve_lines(np.hypot(*away) + out, fairlead[2] + 20.0 + up, 260.0, 0.406 * TONF, 2.2e5 * TONF)
    assert np.isclose(stormy.tension[i], line.tension_fairlead, rtol=1e-9)


def test_steady_forces_add_up_and_push_the_way_they_go(stormy):
    assert set(stormy.loads) == {"wind", "current", "drift"}
    assert np.allclose(sum(stormy.loads.values()), np.array(stormy.steady_force))
    assert np.allclose(stormy.loads["drift"], np.insert(MADE_UP["drift_force"], 2, np.zeros(3)) * 2.25**2)
    assert stormy.loads["wind"][0] < 0 and stormy.loads["current"][1] < 0
    assert stormy.displacement[0] < 0 and stormy.displacement[1] < 0


def test_lines_against_the_load_carry_most(stormy):
    assert stormy.system.line_names[int(np.argmax(stormy.tension))].startswith("fore port")
    assert np.all(stormy.tension >= stormy.equilibrium.lines.tension_b)


def test_calm_leaves_the_body_at_rest():
    calm = multi_point(StandIn(), spread(), HULL, Conditions())
    assert np.abs(calm.displacement).max() < 1e-9
    assert np.allclose(calm.tension, calm.rest.lines.tension_b)
    assert np.all(calm.utilisation < calm.allowable)


def test_surge_period_at_rest_follows_from_mass_and_stiffness():
    calm = multi_point(StandIn(), spread(), HULL, Conditions())
    # slow against heave and pitch, which therefore follow statically: the stiffness seen by surge alone
    flexibility = np.linalg.inv(spread().load().stiffness + STIFFNESS)[0, 0]
    assert np.isclose(calm.at_rest.period[0], 2 * np.pi * np.sqrt(1.2 * MASS * flexibility), rtol=1e-3)


def test_high_waves_lift_anchors_and_say_so():
    result = multi_point(StandIn(), spread(), HULL, storm(waves=Waves(9.0, 10.0, np.radians(240))))
    lifted = result.extreme.vertical_a < 0
    named = [w for w in result.warnings if "lifting the anchor" in w]
    assert lifted.any() == bool(named)
    assert all(result.system.line_names[i] in named[0] for i in np.flatnonzero(lifted))
    assert all("\n" not in line for line in result.warnings)


def test_natural_period_near_the_wave_period_is_warned_of():
    calm = multi_point(StandIn(), spread(), HULL, Conditions())
    surge = calm.at_rest.period[0]
    for ratio, near in ((1.0, True), (1.45, True), (0.75, True), (1.6, False), (0.6, False)):
        text = "".join(resonances(calm, surge / ratio))
        assert ("Surge" in text) == near


def test_roll_near_the_wave_period_is_warned_of():
    roll = multi_point(StandIn(), spread(), HULL, Conditions()).at_rest.period[3]
    for ratio, near in ((1.0, True), (1.3, False)):
        waves = Waves(0.1, roll / ratio, np.radians(240))
        result = multi_point(StandIn(), spread(), HULL, Conditions(waves=waves, method="regular_wave"))
        assert any("roll" in w and "no viscous damping" in w for w in result.warnings) == near


def test_waves_that_do_not_roll_the_body_bring_no_warning_of_roll():
    class Ahead(StandIn):
        def __getitem__(self, name):
            along = np.array([1, 0, 1, 0, 1, 0])
            return super().__getitem__(name) * (along if name in ("rao", "excitation_force") else 1)

    roll = multi_point(Ahead(), spread(), HULL, Conditions()).at_rest.period[3]
    result = multi_point(Ahead(), spread(), HULL, Conditions(waves=Waves(0.1, roll, 0.0), method="regular_wave"))
    assert not any("roll" in w and "no viscous damping" in w for w in result.warnings)


def test_waves_between_stored_ones_are_said_to_be_guesses():
    stored = multi_point(StandIn(), spread(), HULL, storm())
    assert not any("between stored waves; the" in w for w in stored.warnings)
    for waves in (Waves(4.5, 8.0, np.radians(240)), Waves(4.5, 10.0, np.radians(250))):
        warnings = multi_point(StandIn(), spread(), HULL, storm(waves=waves)).warnings
        assert sum(f"waves of {waves.period:g} s" in w and "estimated errors are " in w for w in warnings) == 1


def test_shallow_water_is_said_to_be_outside_the_method(stormy):
    assert any("water depth 20 m is not above 20 m" in w for w in stormy.warnings)
    calm = multi_point(StandIn(), spread(), HULL, Conditions())
    assert calm.warnings == ()


def test_a_body_turned_far_by_its_loads_is_warned_of():
    class Twisted(StandIn):
        def __getitem__(self, name):
            return super().__getitem__(name) + (np.array([0, 0, 2e8]) if name == "drift_force" else 0)

    turned = multi_point(Twisted(), spread(), HULL, storm())
    assert abs(turned.displacement[2]) > 0.1
    assert any("turn the body by" in w for w in turned.warnings)


def test_slack_and_broken_lines_are_named():
    weak = multi_point(StandIn(), spread(breaking_load=100 * TONF), HULL, storm())
    assert any("beyond the breaking load" in w for w in weak.warnings)
    assert weak.utilisation.max() > 1
    loose = multi_point(StandIn(), spread(length=320.0), HULL, Conditions())
    assert any("12 of 12 lines slack at rest" in w for w in loose.warnings)


def test_inextensible_line_that_cannot_follow_is_reported_with_infinite_tension():
    result = multi_point(StandIn(), spread(axial_stiffness=np.inf), HULL, storm())
    beyond = result.extreme.status == State.BEYOND_REACH
    assert beyond.any() == any("beyond reach" in w for w in result.warnings)
    assert np.all(np.isinf(result.tension[beyond]))


def test_study_and_database_have_to_agree_on_the_depth():
    with pytest.raises(ValueError, match="30 m of water, its database for 20 m"):
        multi_point(StandIn(), replace(spread(), depth=30.0), HULL, storm())


def test_a_system_that_is_not_one_body_on_lines_from_anchors_is_refused():
    system = spread()
    line = system.lines[0]
    turned = replace(system, lines=(replace(line, a=line.b, b=line.a), *system.lines[1:]))
    moved = replace(system, bodies=(replace(system.bodies[0], position=(1.0, 0, 0, 0, 0, 0)),))
    for wrong, message in ((turned, "runs from fore port 1 fairlead to"), (moved, "has its axes at")):
        with pytest.raises(ValueError, match=message):
            multi_point(StandIn(), wrong, HULL, Conditions())


def test_incidence_of_the_reports_is_the_opposite_direction():
    study = make_study(tomllib.loads(STUDY))
    conditions = study.conditions()
    assert np.isclose(conditions.wind.direction, np.radians(240))
    assert np.isclose(conditions.waves.direction, np.radians(240))
    assert np.isclose(conditions.current.direction, np.radians(240))
    assert np.isclose(conditions.current.speed, 3 * 1852 / 3600)


def test_head_sea_of_the_reports_reaches_the_bow_first():
    """Amplitudes do not see which way a wave runs, phases do: ε = arg X is the lag behind the crest at the origin."""
    waves = make_study(tomllib.loads(STUDY.replace("period = 10.0\nincidence_deg = 60.0", HEAD_SEA))).conditions().waves
    omega = 2 * np.pi / waves.period
    k = wavenumber(omega, 20.0)
    bow_stern = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    crest = 1j * omega / 9.80665 * incident_wave(bow_stern, waves.direction, omega, k, 20.0)[0]
    assert np.allclose(np.angle(crest), [-k, k])


def test_lines_cut_into_equal_segments_leave_every_result_as_it_is(stormy):
    cut = tuple(
        CompositeLine(
            line.name,
            [Segment(part, line.type.weight, line.type.axial_stiffness, 0.0, line.breaking_load) for part in (200, 60)],
            line.a,
            line.b,
            [PointLoad(200.0, 0.0)],
        )
        for line in stormy.system.lines
    )
    result = multi_point(StandIn(), replace(stormy.system, lines=cut), HULL, storm())
    assert np.allclose(result.tension, stormy.tension, rtol=1e-9)
    assert np.allclose(result.utilisation, stormy.utilisation, rtol=1e-9)
    assert np.allclose(result.displacement, stormy.displacement, rtol=1e-9)
    assert np.allclose(result.at_equilibrium.period, stormy.at_equilibrium.period, rtol=1e-9)
    assert result.warnings == stormy.warnings


def test_the_example_with_lines_of_segments_has_its_pretensions_and_runs(tmp_path, database):
    scene = tmp_path / "study.toml"  # the stand-in has no forces, which irregular waves need
    scene.write_text((SCENES / "moor_chain_and_wire.toml").read_text() + 'method = "regular_wave"\n')
    command(scene, database=database, output=tmp_path / "moor.h5")
    result = moor(scene, database)
    pretension = np.array([35.0] * 8 + [30.0] * 2) * TONF
    assert np.allclose(result.rest.lines.horizontal_b, pretension, rtol=1e-9)
    assert (tmp_path / "moor_plan.png").stat().st_size > 10_000
    composite = [isinstance(line, CompositeLine) for line in result.system.lines]
    assert composite == [True] * 8 + [False, True]


def test_every_number_of_the_results_file_has_its_unit(tmp_path, database):
    """But for shares, factors and the shapes of modes"""
    study, output = tmp_path / "study.toml", tmp_path / "moor.h5"
    study.write_text(STUDY)
    command(study, database=database, output=output)
    bare = {name for name, one in read(output).quantities.items() if one.numeric and not one.unit}
    assert bare == {"tension.used", "allowable", "motion_factor", "mode_shape.at_rest", "mode_shape.under_loads"}


def test_a_line_without_a_breaking_load_has_a_colour_of_its_own_in_the_plan(tmp_path, database, monkeypatch):
    study, drawn = tmp_path / "study.toml", []
    study.write_text(STUDY.replace("breaking_load_tonf = 1700.0\n", ""))
    monkeypatch.setattr("hakobune.pipelines.moor.plan_picture.save", lambda figure, *_: drawn.append(figure))
    command(study, database=database, output=tmp_path / "moor.h5")
    axes = drawn[0].axes[0]
    assert {line.get_color() for line in axes.lines if line.get_linewidth() == 2.5} == {UNKNOWN}
    assert {text.get_text().split("\n")[-1] for text in axes.texts if text.get_text()} == {"unknown"}


def test_a_line_of_rubber_is_said_to_part(database, tmp_path):
    study = tmp_path / "study.toml"
    study.write_text(STUDY.replace("axial_stiffness_tonf = 221700.0", "axial_stiffness_tonf = 90.0"))
    said = " ".join(moor(study, database).warnings)
    assert "are stretched by more than 50 % of their length at the largest tension," in said


def test_command_writes_results_and_plan(tmp_path, database, capsys):
    study, output = tmp_path / "study.toml", tmp_path / "moor.h5"
    text = STUDY.replace("[current]\n", '[current]\nwaves = "still"\n')
    study.write_text(text)
    result = moor(study, database)
    assert command(study, database=database, output=output) == 0
    shown = capsys.readouterr().out
    assert "largest tension" in shown and "surge" in shown
    assert (tmp_path / "moor_plan.png").stat().st_size > 10_000
    file = read(output, "moor")
    assert file.provenance["study"] == text
    assert len(file.provenance["database_sha256"]) == 64
    assert np.array_equal(file["tension.largest"], result.tension)
    assert file.quantity("tension.largest").unit == "N"
    assert file["period.at_rest"].shape == (6,) and file["pose.y"] == result.displacement[1]
    assert file == found(study, database)
    reference = multi_point(StandIn(), spread(axial_stiffness=221700 * TONF), HULL, storm())
    assert np.allclose(result.tension, reference.tension, rtol=1e-9)


def test_command_leaves_no_file_when_the_study_has_no_answer(tmp_path, database):
    study, output = tmp_path / "study.toml", tmp_path / "moor.h5"
    study.write_text(STUDY.replace("period = 10.0", "period = 3.0"))
    with pytest.raises(ValueError, match="period 3 s"):
        command(study, database=database, output=output)
    assert not output.exists()
    with pytest.raises(ValueError, match="is an input of the study"):
        command(study, database=database, output=database)
    assert len(open_database(database).omega) == len(OMEGA)


def test_example_study_is_the_floater_of_the_report():
    study, _ = read_study(SCENES / "moor_chain_12.toml")
    system = study.system(study.hull_of({}), np.zeros(3))
    assert len(system.lines) == 12
    assert np.allclose(rest(system).lines.horizontal_b, 40 * TONF, rtol=1e-9)
    steel = 2 * np.pi / 4 * 142**2 * 7000 * 9.80665
    assert np.isclose(system.lines[0].type.axial_stiffness, steel, rtol=1e-3)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("freeboard = 10.0", "freeboard = 10.0\nfreebord = 3.0", "freebord"),
        ("freeboard = 10.0", "freeboard = -1.0", "hull.freeboard is -1"),
        ("depth = 20.0", 'depth = "deep"', "water.depth"),
        ('type = "chain"', 'type = "rope"', "spreads.0..type is 'rope'; allowed: chain"),
        ("pretension_tonf = 40.0", "", "one of pretension_tonf, pretension_kN"),
        ("speed_knots = 3.0", "speed_knots = 3.0\nspeed = 1.0", "current: speed and speed_knots are given"),
        ("height = 4.5", "height = 0.0", "waves.height is 0"),
        ("direction_deg = 240.0", "", "current: neither is given"),
        ("corner_headings_deg = [30, 45, 60]", "corner_headings_deg = [120]", "corner_headings_deg is 120"),
        ("weight_kg_per_m = 406.0", "weight_kg_per_m = nan", "types.chain.weight_kg_per_m is nan"),
    ],
)
def test_faulty_study_is_refused_by_key_in_one_line(old, new, message):
    assert old in STUDY
    with pytest.raises(ValueError, match=message) as caught:
        study = make_study(tomllib.loads(STUDY.replace(old, new, 1)))
        study.system(study.hull_of({"length": 100.0, "beam": 50.0, "draft": 10.0}), np.zeros(3))
        study.conditions()
    assert "\n" not in str(caught.value)


def test_a_hull_with_a_radius_is_round_and_as_long_and_wide_as_it_is_thick():
    hull = make_study({"water": {"depth": 20.0}}).hull_of({"radius": 3.0, "draft": 2.0})
    assert (hull.length, hull.beam, hull.draft, hull.is_round) == (6.0, 6.0, 2.0, True)


@pytest.mark.parametrize(("size", "lines"), [({"radius": 25.0}, 0), ({"length": 50.0, "beam": 50.0}, 1)])
def test_a_round_hull_is_not_said_to_be_taken_for_a_box(size, lines, monkeypatch):
    """Its volume is 79 % of the box around it"""
    study = make_study(tomllib.loads(STUDY))
    db = SimpleNamespace(
        water_depth=20.0, path="b.h5", bodies=(), modes=(), density=1025.0, displaced_volume=19635.0,
        hydrostatic_stiffness=np.eye(6),
    )  # fmt: skip
    monkeypatch.setattr("hakobune.pipelines.solve.report.doubts", lambda db: ())
    said = study.remarks(study.hull_of(size | {"draft": 10.0}), db)
    assert sum("as on a box" in line for line in said) == lines


def test_contradicting_hull_is_refused():
    study = make_study(tomllib.loads(STUDY.replace("freeboard", "beam = 40.0\nfreeboard")))
    with pytest.raises(
        StudyError, match=r"hull\.beam is 40 m, but the database is for 50 m; change it, or give another database"
    ):
        study.hull_of({"length": 100.0, "beam": 50.0, "draft": 10.0})


def test_lines_without_a_breaking_load_are_not_called_acceptable(tmp_path, database, capsys):
    study = tmp_path / "study.toml"
    study.write_text(STUDY.replace("breaking_load_tonf = 1700.0\n", ""))
    result = moor(study, database)
    command(study, database=database)
    shown = capsys.readouterr().out
    assert np.isnan(result.utilisation).all()
    assert (
        "its utilisation is unknown, since no breaking load is given"
    ) in shown and " 0 % of its breaking load" not in shown
    (said,) = (text for text in result.warnings if "without a breaking load" in text)
    assert all(name in said for name in result.system.line_names)
