"""Which quantities of a sweep are printed, what of a case is kept, and what is told of cases that fail."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.results.quantity import Quantity
from hakobune.pipelines.results.result import Result, labels
from hakobune.pipelines.sweep import command, one_case


def of_cases(values, **more):
    return Quantity(np.asarray(values), ("case",), "", "", **more)


@pytest.fixture
def swept():
    """Two keys, a status, words and ten single numbers of two cases, and one of two lines"""
    made = {"keys.a": of_cases([1.0, 2.0]), "keys.b": of_cases([3.0, 4.0]), "status": of_cases([0, 0])}
    made |= {"word": of_cases(["x", "y"])} | {f"n{i}": of_cases([0.0, float(i)]) for i in range(10)}
    made["tension.largest"] = Quantity(np.zeros((2, 2)), ("case", "line"), "N", "")
    return Result("sweep", made, labels("case", [1, 2]) | labels("line", ["p", "q"]))


@pytest.mark.parametrize("keep, printed", [
    ((), [f"n{i}" for i in range(command.PRINTED)]), (("n9", "tension[*].largest"), ["n9", "tension.largest"]),
    (("word",), ["word"]),
])  # fmt: skip
def test_keys_are_printed_with_what_is_asked_for_or_the_first_eight_numbers(swept, keep, printed):
    shown = command._shown(swept, keep)
    assert [name for name, one in shown.quantities.items() if one.table == "cases"] == [
        *("keys.a", "keys.b"), *sorted(printed, key=list(swept.quantities).index),
    ]  # fmt: skip
    assert {one.table for one in shown.quantities.values()} == {"cases", ""}


def test_five_cases_that_fail_are_named_and_the_rest_counted_with_those_that_were_not_run():
    failed = [(k, 2, f"reason {k}") for k in range(1, 8)]
    outcome = SimpleNamespace(failed=failed, lost=(3, "a worker ended"))
    said = list(command._findings(outcome, Path("s.h5")))
    assert said[:5] == [f"FAILS: case {k}: status 2; reason {k}" for k in range(1, 6)]
    assert said[5:] == [
        "FAILS: 2 more cases have a status above 0; s.h5 has their messages",
        "FAILS: 3 cases were not run, a worker ended; run the same command to continue",
    ]
    five = SimpleNamespace(failed=failed[:5], lost=(0, ""))
    assert len(list(command._findings(five, Path("s.h5")))) == 5


def test_a_sweep_goes_beside_its_study_and_is_checked_before_it_is_run(monkeypatch, swept, capsys, tmp_path):
    order = []
    study = tmp_path / "s.toml"
    outcome = SimpleNamespace(cases=2, failed=[(1, 2, "why")], lost=(0, ""))
    table = SimpleNamespace(keep=("n9",))

    def filled(*given):
        order.append(("filled", *given[:4]))
        given[4]("half done")
        return table, outcome

    monkeypatch.setattr(command, "check_output", lambda *given: order.append(("output", given[0], given[4])))
    monkeypatch.setattr(command, "check_picture", lambda *given: order.append(("picture", given[0])))
    monkeypatch.setattr(command, "filled", filled)
    monkeypatch.setattr(command, "result_of", lambda output: swept)
    monkeypatch.setattr("hakobune.pipelines.sweep.picture.draw", lambda *given: order.append(("drawn", given[1])))
    monkeypatch.setattr(command, "printed", lambda result: order.append(("printed", result.findings)) or 1)
    place = tmp_path / "s.h5"
    assert command.sweep(study, None, "local", True, "p.png") == 1
    assert order == [
        ("output", place, [study]), ("picture", "p.png"), ("filled", study, place, "local", True), ("drawn", "p.png"),
        ("printed", ("FAILS: case 1: status 2; why",)),
    ]  # fmt: skip
    assert capsys.readouterr().err == f"half done\n{place}: 2 cases, of which 1 have a status above 0\n"
    order.clear()
    command.sweep(study, tmp_path / "other.h5", "local", False)
    assert [one[0] for one in order] == ["output", "picture", "filled", "printed"] and order[2][2].name == "other.h5"


def a_result(fails=()):
    made = {"a": Quantity(np.array(1.0), (), "", ""), "b.c": Quantity(np.array([1.0, 2.0]), ("line",), "", "")}
    made["course"] = Quantity(np.array([1.0, 2.0]), ("line",), "", "", record=True)
    made["many"] = Quantity(np.zeros(one_case.SIZE + 1), ("place",), "", "")
    made["few"] = Quantity(np.zeros(one_case.SIZE), ("spot",), "", "")
    axes = labels("line", ["p", "q"]) | labels("place", np.arange(one_case.SIZE + 1))
    return Result(
        "moor", made, axes | labels("spot", np.arange(one_case.SIZE)), tuple(f"FAILS: {one}" for one in fails)
    )


def test_a_case_keeps_what_is_asked_for_or_all_that_is_short(monkeypatch):
    whole = a_result()
    monkeypatch.setattr(one_case, "_called", lambda *given: whole)
    status, said, kept, axes = one_case.one_case("moor", {}, "s.toml", {}, ())
    assert (status, said, list(kept)) == (0, "", ["a", "b.c", "few"]) and axes is whole.labels
    _, _, kept, _ = one_case.one_case("moor", {}, "s.toml", {}, ("course", "b[*].c", "b[q].c"))
    assert list(kept) == ["course", "b.c", "b[q].c"] and kept["b.c"].values.tolist() == [1.0, 2.0]
    assert kept["b[q].c"].values == 2.0
    with pytest.raises(StudyError, match="keep: "):
        one_case.one_case("moor", {}, "s.toml", {}, ("d",))


@pytest.mark.parametrize("keep, kept, said", [
    (("d", "b.c"), ["b.c"], "it breaks; it tilts; the result has no quantity d"),
    (("d", "e"), [], "it breaks; it tilts; the result has no quantity d, e"), (("a",), ["a"], "it breaks; it tilts"),
])  # fmt: skip
def test_a_case_that_fails_names_what_it_lacks_and_keeps_the_rest(monkeypatch, keep, kept, said):
    monkeypatch.setattr(one_case, "_called", lambda *given: a_result(("it breaks", "it tilts")))
    status, told, found, _ = one_case.one_case("moor", {}, "s.toml", {}, keep)
    assert (status, told, list(found)) == (1, said, kept)


def test_a_case_that_is_refused_has_its_reason_in_a_line(monkeypatch):
    def refused(*given):
        raise ValueError("no\n  length")

    monkeypatch.setattr(one_case, "_called", refused)
    assert one_case.one_case("moor", {}, "s.toml", {}, ("a",)) == (2, "no length", {}, {})


def test_a_scene_is_solved_and_a_ctrl_c_ends_the_sweep(monkeypatch):
    """Of arrays of a database a name that is not there is refused, of a scene that failed it is told"""
    arrays = {"rao": Quantity(np.zeros(1000), ("omega",), "", "")}
    answers = [(0, "", arrays, "axes"), (1, "why", arrays, "axes"), (one_case.INTERRUPTED, "", {}, {})]
    asked = []
    monkeypatch.setattr(one_case, "solved", lambda raw, path: asked.append((raw, path)) or answers[len(asked) - 1])
    assert one_case.one_case(one_case.SOLVE, "raw", "s.toml", {}, ()) == (0, "", arrays, "axes")
    assert asked == [("raw", Path("s.toml"))]
    assert one_case.one_case(one_case.SOLVE, "raw", "s.toml", {}, ("rao", "drift")) == (
        1, "why; the result has no quantity drift", arrays, "axes",
    )  # fmt: skip
    with pytest.raises(KeyboardInterrupt):
        one_case.one_case(one_case.SOLVE, "raw", "s.toml", {}, ())
    with pytest.raises(StudyError, match="keep: 'drift' is not a quantity of the result; allowed: rao"):
        one_case.kept(arrays, ("drift",))
