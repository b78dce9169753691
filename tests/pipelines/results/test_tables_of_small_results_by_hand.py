"""What results of small commands tell: every number with its unit, words and table, of parts that are set by hand."""

import hashlib
import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem import __version__
from hakobune.pipelines.breakwater.measured import read_measured
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.damping import result as damping
from hakobune.pipelines.line_dynamics import moordyn
from hakobune.pipelines.members import result as members
from hakobune.pipelines.moor import result as moor
from hakobune.pipelines.printing.timing import Timeline
from hakobune.pipelines.results.provenance import provenance
from hakobune.pipelines.sea import result as sea
from hakobune.pipelines.site import result as site
from hakobune.pipelines.site import states
from hakobune.pipelines.sweep import solved as sweep
from hakobune.pipelines.waves import result as waves


def told(made):
    """{name: (value, unit, words, table)} of single numbers"""
    return {n: (q.values.item() if q.values.ndim == 0 else q.values.tolist(), q.unit, q.description, q.table)
            for n, q in made.items() if not q.record}  # fmt: skip


def test_a_forced_oscillation_is_told_with_every_coefficient_and_its_error(monkeypatch):
    """T = 2π/ω; shares as per cent"""
    made = SimpleNamespace(
        by_harmonics=(11.0, 21.0),
        error=(1.5, 2.5),
        motion=SimpleNamespace(amplitude=0.4, omega=0.5),
        added_mass=7e3,
        linear=10.0,
        quadratic=20.0,
        same_energy=30.0,
        same_force=31.0,
        off=0.02,
        with_cubic=np.array([12.0, 13.0, 0.01]),
        fitted=lambda time: 2 * time,
    )
    monkeypatch.setattr(damping, "forced", lambda *given: made)
    time, force = np.array([0.0, 1.0, 2.0]), np.array([1.0, 5.0, 3.0])
    found, findings, notes = damping._forced(time, None, force, None)
    title = "forced oscillation"
    assert told(found) == {
        "amplitude": (0.4, "m", "amplitude", title),
        "period": (4 * math.pi, "s", "period", title),
        "added_mass": (7e3, "kg", "added mass", title),
        "B1": (10, "N s/m", "B1", title),
        "B1.by_harmonics": (11, "N s/m", "B1 by harmonics", title),
        "B1.error": (1.5, "N s/m", "standard error of B1", title),
        "B2": (20, "N s2/m2", "B2", title),
        "B2.by_harmonics": (21, "N s2/m2", "B2 by harmonics", title),
        "B2.error": (2.5, "N s2/m2", "standard error of B2", title),
        "linear.same_energy": (30, "N s/m", "equivalent linear damping by energy", title),
        "linear.same_force": (31, "N s/m", "equivalent linear damping by largest force", title),
        "left": (0.02, "", "force not explained", title),
        "cubic.B1": (12, "N s/m", "B1 beside a cube", title),
        "cubic.B3": (13, "N s3/m3", "B3", title),
        "cubic.left": (0.01, "", "force not explained even with a cubic term", title),
    }
    assert found["left"].share and found["cubic.left"].share and (findings, notes) == ((), ())
    assert found["record.force"].values.tolist() == [-2, 2, 0] and found["fitted.force"].values.tolist() == [0, 2, 4]
    made.same_energy, made.off = -3e4, 0.5
    findings = damping._forced(time, None, force, None)[1]
    assert len(findings) == 2 and "the equivalent damping by energy is negative, -30" in findings[1].replace("−", "-")


@pytest.mark.parametrize("mass", [None, 4.0])
def test_a_decay_is_told_over_its_mass_and_with_it(monkeypatch, mass):
    made = SimpleNamespace(omega=0.5, a=0.1, b=0.2, linear_only=0.3, linear=0.04, quadratic=0.06, off=0.02,
                           with_cubic=np.array([1.0, 2.0, 0.03]), fitted=np.array([1.0, 0.0]),
                           extremes=np.array([2.0, -1.0, 0.5]))  # fmt: skip
    monkeypatch.setattr(damping, "decay", lambda *given: made)
    found, findings, notes = damping._decay(None, np.array([2.0, -1.0]), mass, "m", None)
    title = "free decay"
    of_mass = {"B1": (0.16, "N s/m", "B1", title), "B2": (0.24, "N s2/m2", "B2", title)}
    assert told(found) == {
        "period": (4 * math.pi, "s", "natural period", title),
        "a": (0.1, "", "a by half cycles", title),
        "b": (0.2, "1/m", "b by half cycles", title),
        "a.alone": (0.3, "", "a of a fit to half cycles with b = 0", title),
        "B1_over_M": (0.04, "1/s", "B1/M", title),
        "B2_over_M": (0.06, "1/m", "B2/M", title),
        "critical": (0.04, "", "B1 over critical damping", title),
        "left": (0.02, "", "motion not explained", title),
        "cubic.B1_over_M": (1, "1/s", "B1/M with a cubic term", title),
        "cubic.B3_over_M": (2, "s/m2", "B3/M", title),
        "cubic.left": (0.03, "", "motion not explained even with a cubic term", title),
    } | (of_mass if mass else {})
    assert found["critical"].share and notes == ("3 extremes from 2 m; M with added mass",) and findings == ()
    assert found["record.motion"].values.tolist() == [2, -1] and found["fitted.motion"].values.tolist() == [1, 0]
    keys = damping._to_paste({"B1": SimpleNamespace(values=4e3), "B2": SimpleNamespace(values=5e3)}, "roll")
    assert keys[0] == (
        "as keys, for roll or whichever motion was recorded: [simulation] linear_damping = { roll = 4 }, "
        "quadratic_damping = { roll = 5 }; in a scene [viscous] roll = { drag = 5000 }"
    )
    assert "B1 contains the damping by the waves" in keys[-1] and damping._to_paste({}, "roll") == ()


@pytest.mark.parametrize("motion", [None, [1 + 1j, 2]])
def test_waves_around_a_body_are_told_with_their_length_and_its_motion(motion):
    """T = 2π/ω, λ = 2π/k; heights and phases of 3 + 4i"""
    around = SimpleNamespace(omega=0.5, k=0.04, beta=0.3, motion=motion and np.array(motion), missed=0.02)
    assert told(waves._waves(around)) == {
        "wave.period": (4 * math.pi, "s", "period", "waves"), "wave.omega": (0.5, "rad/s", "frequency", "waves"),
        "wave.length": (50 * math.pi, "m", "length", "waves"), "wave.heading": (0.3, "rad", "heading", "waves"),
        "body": ("floating" if motion else "held", "", "body", "waves"),
    }  # fmt: skip
    body = SimpleNamespace(words=["surge", "roll"], turning=[False, True])
    found = SimpleNamespace(elevation=np.array([[1j, 2.0]]))
    made = waves._map(around, found, body)
    assert made["body.motion"].unit == ("m/m", "rad/m") and made["map"].axes == ("y", "x") and made["map"].record
    assert (
        np.isnan(made["body.motion"].values).all() if motion is None else made["body.motion"].values.tolist() == motion
    )
    assert made["far_field.missed"].values == 0.02 and made["far_field.missed"].share
    made = waves._heights({"a": (1.0, 2.0, 3 + 4j), "b": (5.0, 6.0, -2.0)})
    assert {n: q.values.tolist() for n, q in made.items()} == {
        "place.height": [5, 2], "place.phase": [pytest.approx(math.atan2(4, 3)), pytest.approx(math.pi)],
        "place.x": [1, 5], "place.y": [2, 6],
    }  # fmt: skip
    assert [(q.unit, q.description) for q in made.values()] == [
        ("", "height"),
        ("rad", "phase"),
        ("m", "x"),
        ("m", "y"),
    ]


def test_places_of_a_map_are_its_highest_and_lowest_both_sides_and_those_asked_for(monkeypatch):
    around = SimpleNamespace(elevation=lambda points: points[:, 0] + 1j * points[:, 1])
    found = SimpleNamespace(around=around, x=np.array([1.0, 2.0]), y=np.array([5.0, 6.0]),
                            elevation=np.array([[1j, np.nan], [0.5, -3.0]]))  # fmt: skip
    monkeypatch.setattr(waves, "sides", lambda around: {"windward": np.array([7.0, 8.0])})
    made = waves._places(found, np.array([[0.25, -1.0]]))
    assert made == {
        "highest": (2, 6, -3),
        "lowest": (1, 6, 0.5),
        "windward": (7, 8, 7 + 8j),
        "0.25, -1 m": (0.25, -1, 0.25 - 1j),
    }


@pytest.mark.parametrize("count", [1, 2])
def test_the_place_of_each_body_has_its_heel(count):
    made = SimpleNamespace(
        amplitudes=np.zeros(6 * count),
        displacement=np.arange(3.0 * count),
        heel=10 + np.arange(2.0 * count),
        allowable=0.5,
        bent=None,
        conditions=SimpleNamespace(motion_factor=1.86),
        equilibrium=SimpleNamespace(stiffness=np.eye(6), residual=np.arange(6.0 * count)),
    )
    found = moor._place(made)
    rows = {"x": [0, 3], "y": [1, 4], "yaw": [2, 5], "roll": [10, 12], "pitch": [11, 13]}
    for name, values in rows.items():
        one = found[f"pose.{name}"]
        assert one.values.tolist() == (values if count > 1 else values[0]) and one.axes == ("body",) * (count > 1)
        assert one.unit == ("m" if name in "xy" else "rad") and one.table == "equilibrium"
    assert [found[f"pose.{name}"].description for name in rows] == [
        "x of the rotation centre", "y of the rotation centre", "yaw", "roll", "pitch"]  # fmt: skip
    assert found["allowable"].values == 0.5 and found["allowable"].share and found["motion_factor"].values == 1.86
    assert found["residual"].values.tolist() == [0, 1, 5, 6, 7, 11][: 3 * count]
    assert found["residual"].unit == ("N", "N", "N m") * count and found["stiffness"].axes == ("force", "motion")


def test_a_site_has_its_contour_states_and_levels_in_si():
    climate = SimpleNamespace(
        law=SimpleNamespace(period_kind="peak_period"), height=[4.0, 5.0, 3.0], period=[9.0, 10.0, 8.0], top=(5.0, 10.0)
    )
    one = SimpleNamespace(fit=None, value=30.0, low=25.0, high=36.0)
    values = SimpleNamespace(
        years=475.0,
        probability=0.9,
        seismic=0.15,
        wind=one,
        waves=None,
        wind_10=28.0,
        climate=climate,
        states={
            "extreme": {
                "waves": {"height": 5.0, "peak_period": 9.0, "direction_deg": 90.0},
                "wind": {"speed": 28.0, "gamma": 3.3},
            }
        },
        levels={"high": 2.0, "low": -1.0},
    )
    made, axes = site._quantities(values)
    contour, state = "contour of 475 years", "state extreme"
    assert told(made) == {
        "return_period": (475, "years", "return period", "site"),
        "probability": (0.9, "", "probability not to be exceeded in the service life", "site"),
        "seismic": (0.15, "", "seismic coefficient", "site"),
        "wind.value": (30, "m/s", "wind as measured", ""),
        "wind.low": (25, "m/s", "wind as measured, from", ""),
        "wind.high": (36, "m/s", "wind as measured, to", ""),
        "wind.ten": (28, "m/s", "wind of ten minutes at 10 m", "site"),
        "extreme.waves.height": (5, "m", "waves height", state),
        "extreme.waves.peak_period": (9, "s", "waves peak_period", state),
        "extreme.waves.direction": (pytest.approx(math.pi / 2), "rad", "waves direction", state),
        "extreme.wind.speed": (28, "m/s", "wind speed", state),
        "extreme.wind.gamma": (3.3, "", "wind gamma", state),
        "level.height": ([2, -1], "m", "above still water", "water levels"),
        "contour.height": ([4, 5, 3], "m", "significant height", ""),
        "contour.period": ([9, 10, 8], "s", "peak period", ""),
        "contour.highest": (5, "m", "highest sea", contour),
        "contour.period_at_highest": (10, "s", "its peak period", contour),
    }
    assert axes["place"].values.tolist() == [1, 2, 3] and axes["level"].values.tolist() == ["high", "low"]
    one.fit = "Gumbel"
    assert site._quantities(values)[0]["wind.low"].table == "extremes and their interval"


@pytest.mark.parametrize(("top", "said"), [(9.0, 0), (9.1, 1)])
def test_a_contour_beyond_the_scatter_is_told(monkeypatch, top, said):
    law = SimpleNamespace(contour=lambda years, hours: ("h", "T"), top=lambda years, hours: (top, 12.0), highest=9.0)
    monkeypatch.setattr("hakobune.mooring.environment.scatter.read_scatter", lambda path: str(path))
    monkeypatch.setattr("hakobune.mooring.site.contours.joint_law", lambda scatter: law)
    findings = []
    made = states.climate_of(SimpleNamespace(scatter="s.csv", hours=3.0), 475.0, "folder", findings)
    assert made == ("folder/s.csv", law, "h", "T", (top, 12.0), 3.0) and len(findings) == said
    if said:
        assert findings[0].startswith(
            "the contour of 475 years reaches 9.1 m, the scatter ends at 9 m: above that height"
        )


def test_time_is_moved_from_one_phase_to_another_with_its_share_of_the_processor():
    """1 of 4 s by the wall takes 2 of 8 s of the processor with it; not more than there is"""
    line = Timeline(lambda: (0.0, 0.0))
    line.seconds |= {"solve": (4.0, 8.0), "estimate": (1.0, 1.0)}
    line.share("solve", "estimate", 1.0)
    assert (line.seconds["solve"], line.seconds["estimate"]) == ((3, 6), (2, 3))
    line.share("solve", "estimate", 99.0)
    assert (line.seconds["solve"], line.seconds["estimate"]) == ((0, 0), (5, 9))
    line.share("nothing", "new", 1.0)
    assert line.seconds["new"] == (0, 0)


def test_a_result_names_its_study_version_and_database(tmp_path):
    path = tmp_path / "b.h5"
    path.write_bytes(b"stored")
    seal = hashlib.sha256(b"stored").hexdigest()
    both = {"database": str(path), "database_sha256": seal}
    assert (
        provenance("a = 1", path, source="report")
        == {"software_version": __version__, "study": "a = 1", "source": "report"} | both
    )
    assert provenance(database=SimpleNamespace(path=path)) == {"software_version": __version__} | both
    assert provenance() == {"software_version": __version__}


def test_measured_values_are_columns_by_name_and_blanks_are_not_known(tmp_path):
    path = tmp_path / "m.csv"
    path.write_text("# tank\nperiod_s,transmission,front_kN_per_m2\n5,0.25,\n8,,3.5\n")
    found = read_measured(path)
    assert {n: v.tolist() for n, v in found.items() if n == "period_s"} == {"period_s": [5, 8]}
    assert found["transmission"] == pytest.approx([0.25, np.nan], nan_ok=True)
    assert found["front_kN_per_m2"] == pytest.approx([np.nan, 3.5], nan_ok=True) and len(found) == 3
    for text, says in (
        ("period_s\n5\n", "has columns period_s; allowed: period_s, transmission, front_kN_per_m2, back_kN_per_m2"),
        ("period_s,transmission,odd\n5,1,1\n", "has columns period_s, transmission, odd; allowed"),
        ("", "has columns none; allowed"),
        ("period_s,transmission\n5,x\n", "has rows that are too short or are not numbers"),
        ("period_s,transmission\n5\n", "has rows that are too short or are not numbers"),
    ):
        path.write_text(text)
        with pytest.raises(StudyError, match=says):
            read_measured(path)


@pytest.mark.parametrize(
    ("amplitudes", "duration", "count"), [(None, 36000.0, 500), ("random", 36000.0, 11460), ("random", 60.0, 500)]
)
def test_random_amplitudes_need_a_component_for_each_frequency_of_the_record(amplitudes, duration, count):
    """2 rad/s, below which 999 thousandths of the energy are, over 36 000 s are 11 459.2 frequencies of 2π/36 000"""
    spectrum = SimpleNamespace(quantile={0.999: 2.0}.__getitem__)
    assert sea._number_of_components(spectrum, SimpleNamespace(amplitudes=amplitudes), duration) == count


def test_the_time_of_members_is_told_a_tenth_of_a_second_each(monkeypatch):
    said = []
    monkeypatch.setattr(members, "told", lambda *given: said.append(given))
    for name, value in {
        "given": (SimpleNamespace(water=SimpleNamespace(density=1.0)), "text"),
        "wind_on": [],
        "placed": [1, 2, 3],
    }.items():
        monkeypatch.setattr(members, name, lambda *_, value=value: value)
    monkeypatch.setattr(members, "wave_of", lambda study: SimpleNamespace(amplitude=0.0))
    monkeypatch.setattr(
        members, "_rows", lambda standing, wind, wave, phases, density: [("a", np.zeros(3), np.ones((len(phases), 6)))]
    )
    monkeypatch.setattr(members, "findings", lambda *given: ["f"])
    monkeypatch.setattr(members, "_notes", lambda wave: ["n"])
    made = members.members("study")
    assert said == [("3 members take", pytest.approx(0.3))] and made.labels["phase"].values.tolist() == [0]
    assert (made.findings, made.notes) == (("f",), ("n",)) and made.labels["member"].values.tolist() == ["a"]


@pytest.mark.parametrize(
    ("mass", "volume", "kept"), [(0.0, 0.0, False), (10.0, 0.0, True), (0.0, 2.0, True), (10.0, 2.0, True)]
)
def test_points_of_a_moordyn_line_with_mass_or_volume_are_its_bodies(monkeypatch, mass, volume, kept):
    joint = SimpleNamespace(mass=mass, volume=volume, drag_area=0.1, added_mass=0.5)
    lines = [
        SimpleNamespace(name=n, length=length, elements=e, bed_friction=0.25 * n)
        for n, length, e in ((2, 50.0, 9), (1, 30.0, 2))
    ]
    system = SimpleNamespace(
        depth=40.0,
        density=1025.0,
        gravity=9.8,
        points=[SimpleNamespace(name=n) for n in "ab"],
        load=lambda: SimpleNamespace(points=[np.array([1.0, 2, 3]), np.array([4.0, 5, 6])]),
    )
    options = {"kBot": "3e6", "cb": None}
    file = SimpleNamespace(option=lambda *names: options.get(names[0]))
    monkeypatch.setattr("hakobune.mooring.formats.moordyn.read_moordyn", lambda path: file)
    monkeypatch.setattr(
        "hakobune.mooring.formats.moordyn_system.system_of_moordyn", lambda file, path, depth, moves: system
    )
    monkeypatch.setattr(moordyn, "_way", lambda system, name: (lines, [joint], "a", "b"))
    monkeypatch.setattr(moordyn, "_type", lambda line, path: f"type {line.name}")
    monkeypatch.setattr(moordyn.msgspec.structs, "replace", lambda one, **changed: {"of": one} | changed)
    study = SimpleNamespace(moordyn=SimpleNamespace(file="m.dat", depth=None, line=2), bed=None, surface=None,
                            fairlead=SimpleNamespace(position=None, table=None))  # fmt: skip
    made = moordyn.with_moordyn(study, "folder")
    assert [tuple(getattr(b, k) for k in ("mass", "volume", "drag_area")) for b in made["bodies"]] == (
        [(mass, volume, 0.1)] if kept else []
    )
    assert [(s.type, s.length, s.elements) for s in made["segments"]] == [("line 2", 50.0, 9), ("line 1", 30.0, 4)]
    assert made["types"] == {"line 2": "type 2", "line 1": "type 1"} and made["anchor"] == (1, 2, 3)
    assert made["bed"].friction == 0.5 and made["bed"].stiffness_kPa_per_m == 3e3 and made["surface"] is True
    assert made["fairlead"]["position"] == (4, 5, 6)
    assert (made["water"].depth, made["water"].density, made["water"].gravity) == (40.0, 1025.0, 9.8)


def test_a_scene_of_a_sweep_is_solved_with_its_files_beside_it(monkeypatch, tmp_path):
    raws = []
    outcome = SimpleNamespace(path="p", remarks=["FAILS: a", "note"], exit_status=0)
    monkeypatch.setattr("hakobune.pipelines.scene.scene.make_scene", lambda raw: raws.append(raw) or "scene")
    monkeypatch.setattr("hakobune.pipelines.solve.run.solve", lambda scene, path: outcome)
    monkeypatch.setattr("hakobune.bem.database.open_database", lambda path: SimpleNamespace(bodies=()))
    monkeypatch.setattr("hakobune.pipelines.solve.report.failures", lambda *given: ["FAILS: b"])
    monkeypatch.setattr("hakobune.pipelines.solve.report.gives_panels", lambda scene: True)
    monkeypatch.setattr(sweep, "_arrays", lambda path, bodies: {"x": 1})
    raw = {"bodies": [{"file": "hull.gdf"}, {"shape": "box"}]}
    status, said, arrays, axes = sweep.solved(raw, tmp_path / "scene.toml")
    assert raws[0]["bodies"] == [{"file": str(tmp_path / "hull.gdf")}, {"shape": "box"}]
    assert (status, said, arrays) == (1, "a; b", {"x": 1}) and axes
    outcome.exit_status = 130
    assert sweep.solved({}, tmp_path / "s")[0] == 130
    monkeypatch.setattr("hakobune.pipelines.solve.report.failures", lambda *given: [])
    outcome.exit_status, outcome.remarks = 0, []
    assert sweep.solved({}, tmp_path / "s")[:2] == (0, "")

    def refuse(raw):
        raise ValueError("no water")

    monkeypatch.setattr("hakobune.pipelines.scene.scene.make_scene", refuse)
    assert sweep.solved({}, tmp_path / "s") == (2, "no water", {}, {})


@pytest.mark.parametrize(
    ("names", "found", "sizes"),
    [
        (("t (s)", "roll (deg)"), ["time_s", "motion_deg"], [1, 1]),
        (("Time [ms]", "pitch [rad]"), ["time_s", "motion_deg"], [1e-3, 180 / math.pi]),
        (("t_s", "heave_cm"), ["time_s", "motion_m"], [1, 0.01]),
        (("t (s)", "heave (mm)"), ["time_s", "motion_m"], [1, 1e-3]),
        (("t (s)", "heave (kN)"), None, None),
        (("x (s)", "heave (m)"), None, None),
        (("t (kg)", "heave (m)"), None, None),
        (("t (s)",), None, None),
        (None, None, None),
    ],
)
def test_a_decay_may_name_its_units_in_its_head(names, found, sizes):
    values = np.array([[1.0, 2.0], [3.0, 4.0]])
    made = damping._decay_by_units("d.csv", names, values)
    if found is None:
        assert made is None
    else:
        assert made[0] == found and made[1] == pytest.approx(values * sizes)


def test_records_on_an_axis_are_columns_of_a_file_and_the_rest_is_left_out(tmp_path):
    from hakobune.pipelines.results import records
    from hakobune.pipelines.results.quantity import Quantity
    from hakobune.pipelines.results.result import Result, labels

    time = [0.0, 0.5]
    made = Result("berth", {
        "a": Quantity([1.0, 2.0], ("time",), "N", "a", record=True), "b": Quantity(3.0, (), "m", "b"),
        "c": Quantity([[4.0, 5.0], [6.0, 7.0]], ("time", "line"), "m", "c", record=True),
        "d": Quantity([8.0, 9.0], ("line",), "", "d", record=True), "e": Quantity([0.25, 0.75], ("time",), "", "e"),
        "f": Quantity([10.0, 11.0], ("time",), "", "f", record=True),
    }, labels("time", time, "s") | labels("line", ["x", "y"]))  # fmt: skip
    path = tmp_path / "r.csv"
    records.write_records(made, path)
    first, head, *rows = path.read_text().splitlines()
    assert first == "# hakobune berth, records" and head.split(",")[:2] == ["time [s]", "a [N]"]
    assert [word.endswith("[m]") for word in head.split(",")] == [False, False, True, True, False]
    assert [list(map(float, row.split(","))) for row in rows] == [[0, 1, 4, 5, 10], [0.5, 2, 6, 7, 11]]
    records.check_records(path, "berth")
    with pytest.raises(ValueError, match="is not a course of sea, so it is not replaced"):
        records.check_records(path, "sea")
    whole = tmp_path / "r.h5"
    records.write_records(made, whole)
    records.check_records(whole, "berth")
    with pytest.raises(ValueError, match="is not a course of sea"):
        records.check_records(whole, "sea")


def test_a_scene_is_as_broad_as_its_first_body_or_its_diameter():
    from hakobune.pipelines.scene.scene import Scene

    for beam, radius, wanted in ((20.0, None, 20.0), (None, 7.0, 14.0)):
        one = SimpleNamespace(body=SimpleNamespace(beam=beam, radius=radius))
        assert Scene.beam.fget(one) == wanted
