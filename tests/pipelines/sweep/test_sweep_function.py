"""`hakobune.sweep`: each case is what its study function gives alone."""

import copy
import dataclasses
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import tomli_w

import hakobune
from hakobune.mooring.criteria.failing import fails
from hakobune.pipelines.sweep import one_case, run
from hakobune.pipelines.sweep.study import COMMANDS, read_sweep

BERTH = {
    "depth": 25.0,
    "ship": {"length": 337.5, "beam": 53.6, "draft": 19.7, "displacement": 291649.0},
    "approach": {"speed": 0.15, "eccentricity": 0.7},
    "fender": [{"family": "v", "height": 1.0, "length": 20.0, "dolphin": 34000.0}],
}
SWEEP = {
    "command": "berth",
    "study": BERTH,
    "vary": [{"key": "approach.speed", "values": [0.1, 0.150001, 0.15]}],
    "keep": ["approach.energy", "course.largest"],
}


def test_a_case_equals_its_study_alone_to_the_bit(tmp_path):
    cases = hakobune.sweep(SWEEP)
    for number, speed in enumerate([0.1, 0.150001, 0.15]):
        study = copy.deepcopy(BERTH)
        study["approach"]["speed"] = speed
        alone = hakobune.berth(study)
        for name in SWEEP["keep"]:
            assert cases[name][number] == alone[name] and cases.quantity(name).unit == alone.quantity(name).unit
    assert cases["approach.energy"][1] > cases["approach.energy"][2]


def test_path_and_tables_give_the_same_and_the_file_is_read_as_the_result(tmp_path):
    (tmp_path / "berth.toml").write_text(tomli_w.dumps(BERTH))
    (tmp_path / "sweep.toml").write_text(tomli_w.dumps({**SWEEP, "study": "berth.toml"}))
    kept, beside = tmp_path / "cases.h5", {**SWEEP, "study": str(tmp_path / "berth.toml")}
    by_path = hakobune.sweep(tmp_path / "sweep.toml", kept)
    assert hakobune.read(kept) == by_path
    for given in (SWEEP, beside):
        assert all(hakobune.sweep(given).quantities[name] == one for name, one in by_path.quantities.items())


def test_a_case_that_is_refused_fails_with_its_number():
    cases = hakobune.sweep({**SWEEP, "vary": [{"key": "approach.speed", "values": [0.1, -0.1]}]})
    assert list(cases["status"]) == [0, 2] and cases.status == 1
    (said,) = cases.fails
    assert said.startswith("case 1: ") and "speed" in said


def test_a_key_that_is_none_is_refused_before_any_case(tmp_path):
    with pytest.raises(ValueError, match="speeed"):
        hakobune.sweep({**SWEEP, "vary": [{"key": "approach.speeed", "values": [0.1]}]}, tmp_path / "none.h5")
    assert not list(tmp_path.iterdir())


def test_the_energy_of_a_berthing_grows_with_the_square_of_its_speed_and_what_is_too_much_fails_its_case():
    """½ m v² of the tanker on fenders that take up 0.1 m/s and no 0.4"""
    speeds = [0.1, *np.linspace(0.4, 1.0, 7).tolist()]
    found = hakobune.sweep(
        {**SWEEP, "keep": ["approach.energy"], "vary": [{"key": "approach.speed", "values": speeds}]}
    )
    assert found["status"].tolist() == [0] + [1] * 7
    energy = found["approach.energy"]
    assert energy == pytest.approx(energy[0] * (np.array(speeds) / 0.1) ** 2, rel=1e-9)
    assert [line.split(":")[0] for line in found.fails] == [f"case {i}" for i in range(1, 8)]


def test_what_a_failing_case_lacks_is_nan_and_named_and_the_others_keep_it(monkeypatch):
    """A mooring that fails may have no tension: the sweep goes on, and a name that no sound case has is refused"""
    whole = hakobune.berth({**BERTH, "approach": {"speed": 0.1, "eccentricity": 0.7}})
    broken = dataclasses.replace(whole, quantities={}, labels={}, findings=(fails("it capsizes"),))
    found = iter([whole, broken])
    monkeypatch.setattr("hakobune.pipelines.sweep.one_case._called", lambda *_: next(found))
    cases = hakobune.sweep({**SWEEP, "vary": [{"key": "approach.speed", "values": [0.1, 0.2]}]})
    assert cases["approach.energy"][0] == whole["approach.energy"] and np.isnan(cases["approach.energy"][1])
    assert cases.fails == ("case 1: it capsizes; the result has no quantity approach.energy, course.largest",)
    found = iter([dataclasses.replace(whole, quantities={}, labels={})])
    with pytest.raises(ValueError, match=r"keep: .*approach\.energy"):
        hakobune.sweep({**SWEEP, "vary": [{"key": "approach.speed", "values": [0.1]}]})


def test_cases_are_stored_together_every_half_second_and_at_the_end(monkeypatch):
    stored, clock = [], iter([0.0, 0.2, 0.6, 0.6, 0.9])
    monkeypatch.setattr(run.file, "store", lambda _, rows: stored.append(list(rows)))
    monkeypatch.setattr(run, "time", SimpleNamespace(monotonic=lambda: next(clock)))
    with run._kept_together("a.h5") as keep:
        for case in (1, 2, 3):
            keep(case)
        assert stored == [[1, 2]]
    assert stored == [[1, 2], [3]]


LINES = {
    "water": {"depth": 60.0},
    "types": {"chain": {"catalogue": "R3 studless 76 mm"}},
    "anchors": [{"name": "A", "position": [-300.0, 0.0, -60.0]}, {"name": "B", "position": [0.0, 0.0, 0.0]}],
    "lines": [{"name": "one", "type": "chain", "length": 320.0, "from": "A", "to": "B"}],
}


def test_lines_are_swept_like_any_study():
    """Its file is called the system by the function and the file by the command"""
    cases = hakobune.sweep({"command": "lines", "study": LINES, "keep": ["tension.b"],
                            "vary": [{"key": "lines[0].length", "values": [315.0, 320.0]}]})  # fmt: skip
    for number, length in enumerate([315.0, 320.0]):
        study = copy.deepcopy(LINES)
        study["lines"][0]["length"] = length
        assert np.array_equal(cases["tension.b"][number], hakobune.lines(study)["tension.b"])
    assert cases.status == 0


@pytest.mark.parametrize("command", COMMANDS)
def test_arguments_of_every_command_are_those_of_its_function_without_its_study(command):
    """Numbers and paths as the command reads them; a file that is always written is no argument of a case"""
    needed = ["--database", "x.h5"] if command in ("moor", "response", "simulate") else []
    assert one_case.given_to(command, needed) == ({"database": Path("x.h5")} if needed else {})
    if command in ("moor", "response"):
        with pytest.raises(ValueError, match="arguments contain --output; allowed in a sweep: the flags of hakobune"):
            one_case.given_to(command, [*needed, "--output", "found.h5"])
    if command == "simulate":
        found = one_case.given_to(command, [*needed, "--seeds", "3", "--duration", "60"])
        assert (found["seeds"], found["duration"]) == (3, 60.0)
        with pytest.raises(ValueError, match="arguments contain --methods"):
            one_case.given_to(command, [*needed, "--methods"])


def test_cases_whose_worker_is_lost_are_counted_and_the_first_is_told(tmp_path):
    """Two of three are lost; what is left is stored, and a second run has the two to do"""
    (tmp_path / "berth.toml").write_text(tomli_w.dumps(BERTH))
    table, text = read_sweep(_written(tmp_path, "berth.toml"))
    said, output = [], tmp_path / "cases.h5"

    class Executor:
        count = 1

        def submit(self, function, command, case, *more):
            class Future:
                def result(self):
                    if case["approach"]["speed"] > 0.12:
                        raise RuntimeError("worker\n gone")
                    return function(command, case, *more)

            return Future()

    outcome = run.sweep(table, text, tmp_path, output, Executor(), said.append)
    assert outcome.cases == 3 and outcome.lost == (2, "case 1: worker gone") and outcome.failed == []
    assert said == ["3 cases, 0 of them stored already", *[f"{done} of 3 cases" for done in (1, 1, 1)]]
    assert run.file.pending(output) == [1, 2]
    with pytest.raises(ValueError, match="belongs to another sweep; give --fresh"):
        run.sweep(table, f"{text}# more", tmp_path, output, Executor(), said.append)


def _written(folder, study):
    (folder / "sweep.toml").write_text(tomli_w.dumps({**SWEEP, "study": study}))
    return folder / "sweep.toml"
