"""A ship at a quay: fenders, dolphins and ropes of a study file, through the file of a simulation."""

import json
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from result_views import check_views

import hakobune
from hakobune import pipelines
from hakobune.bem.database import open_database
from hakobune.bem.time_domain.memory import no_memory
from hakobune.mooring.environment.wave_records import Record, write_record
from hakobune.mooring.lines.system.parts import LineSystemError
from hakobune.mooring.studies.conditions import ExposedBox
from hakobune.mooring.studies.natural_periods import periods_at_berth
from hakobune.pipelines.cli import main
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.moor.quay import body_of
from hakobune.pipelines.moor.study import make_study, read_study
from hakobune.pipelines.simulate.berth import by_design_spectrum, findings_on_periods
from hakobune.pipelines.simulate.file import opened
from hakobune.pipelines.simulate.study import plan_of

SCENE = Path(pipelines.__file__).parent / "scenes" / "simulate_quay.toml"
HULL = ExposedBox(100.0, 50.0, 10.0, 10.0)
WIDE = np.linspace(0.05, 2.0, 40)
FENDER = {"name": "F", "position": [0, 25, 0], "family": "cell", "height": 1.7}
ROPE = {
    "name": "R", "fairlead": [0, 20, 8], "bollard": [0, 40, 4], "breaking_load_kN": 1000, "break_strain": 0.1,
}  # fmt: skip


def without_memory(body, motions=None):
    """Memory without states, so that none has to be fitted, and the added mass of the longest waves; no findings"""
    return replace(no_memory(body), added_mass_infinity=body.coefficients(body.omega[:1])[0][0]), ()


@pytest.fixture(scope="module")
def database(tmp_path_factory):
    path = tmp_path_factory.mktemp("quay") / "box.h5"
    words = "box --length 100 --beam 50 --draft 10 --depth 20 --omega 0.3:1.5:8 --heading 0:90:3 --tolerance 0.05"
    assert main([*words.split(), "--gyration", "15.55,29.44,32.28", "--output", str(path)]) == 0
    return path


def test_a_ship_at_a_quay_is_simulated_stored_and_told(database, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("hakobune.mooring.motion.simulation.moored_body.fitted_memory", without_memory)
    run, words = tmp_path / "quay.h5", ["simulate", str(SCENE), "--database", str(database)]
    more = ["--duration", "60", "--seeds", "1", "--output", str(run)]
    failing = 1  # breast lines carry 41 % of their strength, 40 % are allowed
    assert main([*words, *more, "--windows", "30", "--methods", "--division", str(database), "--json"]) == failing
    found = json.loads(capsys.readouterr().out)
    values = {name: one["values"] for name, one in found["quantities"].items()}
    assert found["axes"]["method"]["values"][0].startswith("1 memory, divided") and len(values["method.surge"]) == 4
    assert values["method.sway"][0] == values["method.sway"][1]  # the box divided is the box
    assert found["axes"]["window"]["values"] == [0.0, 30.0] and values["natural_period"][0] > 0
    assert values["strain.allowable"] == [0.5] * 4 and 0 < max(values["strain.largest"]) < 0.5
    load, most = np.array(values["line.breaking_load"]), np.array(values["tension.largest"])
    assert values["line.working_load"] == pytest.approx(0.4 * load)
    assert values["tension.used_of_working"] == pytest.approx(most / (0.4 * load))
    assert values["reaction.used"] == pytest.approx(np.divide(values["reaction.largest"], values["reaction.rated"]))
    assert not any("does not cover" in one["text"] for one in found["findings"])
    assert main([*words, *more]) == failing
    told = capsys.readouterr().out
    assert "deflection" in told and "head 1" in told and "natural period" in told
    monkeypatch.setenv("COLUMNS", "40")
    made = hakobune.simulate(SCENE, database, run, duration=60.0, seeds=1)
    check_views(made, [*words, *more], tmp_path / "quay_result.h5", capsys)
    assert made["natural_period"].tolist() == values["natural_period"]
    with opened(run) as file:
        names = list(file["quantity"].asstr()[()])
        assert file["deflection"].shape == (1, 121, 4) and file["tension"].shape == (1, 121, 12)
        assert file["statistics"][0, names.index("deflection F1"), 0] == pytest.approx(
            file["deflection"][0, :, 0].mean(), rel=1e-5
        )
    again = [*words, "--duration", "60", "--seeds", "1", "--output", str(run), "--windows"]
    assert main([*again, "61"]) == 2
    assert "--windows is 61 s; allowed: 2.5 s to the duration, 60 s" in capsys.readouterr().err
    film = tmp_path / "film.gif"
    assert main(["animate", str(run), "--output", str(film), "--length", "2"]) == 0 and film.stat().st_size > 1000
    assert main(["moor", str(SCENE), "--database", str(database)]) == 2
    assert "moor of one body does not support [[fender]]" in capsys.readouterr().err


def test_a_floater_between_dolphins_has_the_design_spectrum_method_beside(database, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("hakobune.mooring.motion.simulation.moored_body.fitted_memory", without_memory)
    run, scene = tmp_path / "dolphins.h5", SCENE.with_name("simulate_dolphins.toml")
    words = [
        "simulate",
        str(scene),
        "--database",
        str(database),
        "--duration",
        "60",
        "--output",
        str(run),
    ]
    assert main(words) == 0
    told = capsys.readouterr().out
    assert "natural period of small motions" in " ".join(told.replace("┃", " ").split())
    assert "design spectrum method, 3 fenders: static 0.06" in told and "up to a significant height of " in told
    assert all((tmp_path / f"dolphins_{name}.png").exists() for name in ("records", "spectra", "offsets", "extremes"))
    assert main(["animate", str(run), "--output", str(tmp_path / "film.gif"), "--length", "2"]) == 0
    assert (tmp_path / "film.gif").read_bytes()[:6] == b"GIF89a"


@pytest.mark.parametrize(
    "asked, told", [('["nix"]', "there is no line 'nix'"), ('"all"', "has no mass"), ('"every"', '"all"')]
)
def test_lines_that_cannot_move_by_themselves_leave_no_file(database, tmp_path, monkeypatch, capsys, asked, told):
    monkeypatch.setattr("hakobune.mooring.motion.simulation.moored_body.fitted_memory", without_memory)
    study, run = tmp_path / "study.toml", tmp_path / "run.h5"
    chains = SCENE.with_name("simulate_chain_12.toml").read_text()
    chains = chains.replace('catalogue = "R3 studlink 142 mm"\n', "")
    study.write_text(chains.replace("[simulation]", f"[simulation]\ndynamic_lines = {asked}"))
    words = [
        "simulate",
        str(study),
        "--database",
        str(database),
        "--duration",
        "60",
        "--no-pictures",
        "--output",
        str(run),
    ]
    assert main(words) == 2
    error = capsys.readouterr().err
    assert told in error and error.strip().count("\n") == 0 and not run.exists()


def test_a_fender_on_a_dolphin_gives_way_with_it():
    study = read_study(SCENE)[0]
    assert len(study.berth(HULL, np.zeros(3)).names) == 16
    raw = {"water": {"depth": 20}, "hull": {"freeboard": 10}, "fender": [FENDER | {"on": "D"}]}
    raw["dolphin"] = [{"name": "D", "stiffness": 5000.0}]
    (pair,) = make_study(raw).berth(HULL, np.zeros(3)).fenders
    soft = make_study(raw | {"dolphin": [], "fender": [FENDER]}).berth(HULL, np.zeros(3)).fenders[0].fender
    force = float(soft.reaction(0.3))
    assert float(pair.fender.reaction(0.3 + force / 5e6)) == pytest.approx(force, rel=1e-3)


def test_natural_periods_of_a_berth_are_those_of_its_springs_and_are_told_beside_the_harbours():
    mass = np.diag([4.0, 4.0, 4.0, 9.0, 9.0, 9.0])
    stiffness = np.diag([1.0, 4.0, 5.0, 5.0, 5.0, 81.0])
    stiffness[1, 5] = stiffness[5, 1] = 0.5
    body = SimpleNamespace(reader=SimpleNamespace(inertia=mass), slow_added_mass=0 * mass, stiffness=stiffness)
    found = periods_at_berth(body)
    assert found == pytest.approx([4 * np.pi, 2 * np.pi, 2 * np.pi / 3], rel=2e-2)
    assert found[0] == pytest.approx(4 * np.pi, rel=1e-12) and found[1] > 2 * np.pi
    near = list(findings_on_periods(SimpleNamespace(attrs={"natural_period": found, "harbour_period": [14.0, 100.0]})))
    assert (
        len(near) == 1 and "s, is near the natural period of the harbour, 14 s, so the two resonate; change" in near[0]
    )
    attrs = {"natural_period": [12.0, 24.0, 50.0], "harbour_period": [10.0, 20.1, 62.0, 63.0]}  # within a fifth of it
    near = list(findings_on_periods(SimpleNamespace(attrs=attrs)))
    told = [line.split(";")[0].removeprefix("the natural period of ") for line in near]
    assert told == [f"{motion} at the berth, {own} s, is near the natural period of the harbour, {swings} s, "
                    "so the two resonate"
                    for motion, own, swings in (("surge", 12, 10), ("sway", 24, 20.1), ("yaw", 50, 62))]  # fmt: skip
    assert not list(findings_on_periods(SimpleNamespace(attrs={"natural_period": [12.0]})))


def test_waves_of_a_record_beside_the_study_move_the_ship(tmp_path):
    raw = {"water": {"depth": 20}, "hull": {"freeboard": 10}, "fender": [FENDER]}
    raw["simulation"] = {"duration": 200.0, "ramp": 50.0, "record": {"file": "berth.csv", "direction_deg": 90}}
    t = np.arange(0, 260.0, 1.0)
    write_record(tmp_path / "berth.csv", Record(0.2 * np.sin(2 * np.pi * t / 25), 1.0))
    plan = plan_of(make_study(raw), np.linspace(0.1, 2.0, 20), folder=tmp_path)
    waves = plan.weather.components
    top = int(np.argmax(waves.amplitude))
    assert waves.omega[top] == pytest.approx(2 * np.pi / 25, rel=0.01) and waves.direction[top] == np.pi / 2
    assert not plan.weather.seas and plan.mean_period == pytest.approx(25, rel=0.1)
    for change, says in (
        ({"duration": 300.0}, "simulation.record lasts 259 s; allowed: ramp and duration, 350 s"),
        ({"record": {"file": "none.csv", "direction_deg": 90}}, "none.csv does not exist"),
        ({"record": {"file": "berth.csv"}}, "simulation.record: neither is given; give one of direction_deg"),
        ({"constant_period": 60.0}, 'allowed: above 0, with memory = "constant"'),
    ):
        with pytest.raises(StudyError, match=re.escape(says)):
            plan_of(make_study(raw | {"simulation": raw["simulation"] | change}), WIDE, folder=tmp_path)


@pytest.mark.parametrize(
    "tables, says",
    [
        (
            {"fender": [FENDER | {"position": [60, 30, 0]}]},
            "fender[0] (F): the body cannot reach the point 60, 30, 0 m",
        ),
        ({"fender": [FENDER | {"position": [0, 40, 0]}]}, "at most 10 m from it"),
        ({"fender": [FENDER | {"causes": ["ageing"]}]}, "fender[0] (F).causes is given"),
        ({"fender": [FENDER | {"on": "D"}]}, "there is no dolphin 'D'; allowed: none is given"),
        ({"dolphin": [{"name": "D", "stiffness": 1.0}]}, "dolphin 'D' carries no fender"),
        ({"fender": [FENDER, FENDER]}, "'F' is the name of two fenders or ropes"),
        (
            {"rope": [ROPE | {"pretension_kN": 1100}]},
            "pretension is 1100 kN; allowed: below its breaking load of 1000 kN",
        ),
        ({"rope": [ROPE | {"tail_length": 5.0}]}, "rope R: tail_break_strain is missing"),
        ({"simulation": {"duration": 9.0, "linear_damping": {"sorge": 1.0}}}, "there is no motion 'sorge'"),
    ],
)
def test_an_impossible_berth_is_told_in_one_line(tables, says):
    from hakobune.pipelines.simulate.study import damping

    raw = {"water": {"depth": 20}, "hull": {"freeboard": 10}} | tables
    with pytest.raises((StudyError, LineSystemError, ValueError)) as caught:
        study = make_study(raw)
        study.berth(HULL, np.zeros(3))
        damping(study, SimpleNamespace(damping=np.zeros((6, 6)), words=("surge",)))
    assert says in str(caught.value) and "\n" not in str(caught.value)


DOLPHINS = {
    "water": {"depth": 20.0}, "hull": {"freeboard": 10.0},
    "fender": [{**FENDER, "position": [0, 25.5, 0], "overload": 50000.0}],
    "waves": {"height": 0.7, "period": 8.0, "direction_deg": 90.0},
    "wind": {"speed": 15.0, "direction_deg": 90.0},
    "simulation": {"duration": 20.0, "memory": "constant"},
}  # fmt: skip


def test_a_quay_behind_dolphins_changes_waves_water_and_the_design_spectrum(database, monkeypatch):
    monkeypatch.setattr("hakobune.bem.wave_field.before_wall.FEWEST", 12)
    monkeypatch.setattr("hakobune.bem.wave_field.before_wall.MOST", 24)
    db, lines = open_database(database), []
    for quay in ({}, {"quay": {"y": 75.0}}):
        study = make_study({**DOLPHINS, **quay})
        body, told = body_of(study, db)
        hull = study.hull_of(db.dimensions)
        lines.append(by_design_spectrum(study, db, body, hull, study.berth(hull, db.rotation_center).fenders))
    assert all(line.startswith("design spectrum method, 1 fenders") for line in lines) and lines[0] != lines[1]
    assert told[0].startswith("the quay at y = 75 m is computed by the far field")


@pytest.mark.parametrize(
    ("quay", "said"),
    [
        ({"y": 20.0}, "a wall at y = 20 m intersects the hull"),
        (
            {"y": 26.0},
            "are not included, although .* % of their height is left .*; allowed: up to 30 %; solve the body with "
            "hakobune solve --wall",
        ),
        ({"y": 75.0, "method": "panels"}, "is of open water; solve it again with --wall 75"),
        ({"y": 75.0, "method": "guess"}, r"quay\.method is 'guess'; allowed: far-field, panels"),
    ],
)
def test_a_quay_that_does_not_fit_is_refused(database, quay, said, monkeypatch):
    monkeypatch.setattr("hakobune.bem.wave_field.before_wall.FEWEST", 12)
    monkeypatch.setattr("hakobune.bem.wave_field.before_wall.MOST", 24)
    with pytest.raises(StudyError) as refused:
        body_of(make_study({**DOLPHINS, "quay": quay}), open_database(database))
    assert re.search(said, str(refused.value))


def test_memory_in_states_is_refused_before_a_quay_by_the_far_field(database, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("hakobune.bem.wave_field.before_wall.FEWEST", 12)
    monkeypatch.setattr("hakobune.bem.wave_field.before_wall.MOST", 24)
    study = tmp_path / "quay.toml"
    text = SCENE.read_text().replace("[simulation]", "[quay]\ny = 60.0\n\n[simulation]")
    study.write_text(text)
    words = ["simulate", str(study), "--database", str(database), "--output", str(tmp_path / "run.h5")]
    assert main(words) == 2
    assert 'allowed: "constant"' in capsys.readouterr().err.replace("\n", " ")
    assert not (tmp_path / "run.h5").exists()


@pytest.fixture(scope="module")
def before_wall(tmp_path_factory):
    path = tmp_path_factory.mktemp("quay") / "wall.h5"
    words = "box --length 100 --beam 50 --draft 10 --depth 20 --omega 0.4:1.2:8 --heading 0:90:3 --panels 72 --wall 60"
    main([*words.split(), "--gyration", "15.55,29.44,32.28", "--output", str(path)])  # coarse: some checks say so
    return path


def test_dolphins_on_a_database_with_a_wall_take_one_frequency_and_are_told_that_no_drift_is_known(
    before_wall, tmp_path, monkeypatch, capsys
):
    plain = SCENE.with_name("simulate_dolphins.toml").read_text()
    found = []
    for i, text in enumerate((plain, plain + "[quay]\ny = 60.0\n")):
        study, run = tmp_path / f"{i}.toml", tmp_path / f"{i}.h5"
        study.write_text(text)
        words = [
            "simulate",
            str(study),
            "--database",
            str(before_wall),
            "--duration",
            "60",
            "--no-pictures",
            "--output",
            str(run),
        ]
        assert main(words) == 0
        told = capsys.readouterr()
        assert "wave drift in front of the quay is unknown and not included" in told.out + told.err
        with opened(run) as file:
            found.append(file["statistics"][:])
    assert np.array_equal(*found, equal_nan=True)
    study.write_text(study.read_text().replace('memory = "constant"', 'memory = "states"'))
    assert main([*words[:-1], str(tmp_path / "states.h5")]) == 2
    error = capsys.readouterr().err
    assert 'is "states" in front of a quay; allowed: "constant"' in error and error.count("\n") == 1
    assert not (tmp_path / "states.h5").exists()
