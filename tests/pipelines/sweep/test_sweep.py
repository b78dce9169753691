"""Many cases of one study: the same numbers from every executor, taken up where they stopped."""

import shutil
import tomllib

import h5py
import numpy as np
import pytest

import hakobune
from hakobune.pipelines import cli
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.keys.kinds import SCENES
from hakobune.pipelines.sweep import one_case, run
from hakobune.pipelines.sweep.file import result_of
from hakobune.pipelines.sweep.study import SweepTable, VaryTable, cases, put

SWEEP = """command = "berth"
study = "berth_tanker.toml"
[[vary]]
key = "approach.speed"
values = [0.1, 0.15, 0.2]
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    shutil.copy(SCENES / "berth_tanker.toml", tmp_path)
    (tmp_path / "sweep.toml").write_text(SWEEP)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def numbers(path):
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def test_energies_of_berthing_over_speed_are_kinetic(folder):
    assert cli.main(["sweep", "sweep.toml", "--output", "one.h5"]) == 0
    one = numbers("one.h5")
    energy = one["results/method.energy"]
    assert np.allclose(energy / one["keys/approach.speed"][:, None] ** 2, energy[0] / 0.01, rtol=1e-12)  # ½ m v²
    assert sorted(path.name for path in folder.iterdir()) == ["berth_tanker.toml", "one.h5", "sweep.toml"]


def test_neighbouring_values_give_other_results_those_of_the_command_alone_to_the_bit(folder):
    (folder / "sweep.toml").write_text(SWEEP.replace("0.1, 0.15, 0.2", "0.15, 0.150001"))
    assert cli.main(["sweep", "sweep.toml"]) == 0
    found = result_of(folder / "sweep.h5")
    for case, speed in enumerate((0.15, 0.150001)):
        raw = tomllib.loads((folder / "berth_tanker.toml").read_text())
        raw["approach"]["speed"] = speed
        alone = hakobune.berth(raw)
        for name, one in alone.quantities.items():
            if name in found and one.numeric:
                assert np.array_equal(found[name][case], one.values, equal_nan=True), name
        assert {"method.energy", "method.C_M"} <= set(found) & set(alone)
    assert np.all(found["method.energy"][0] < found["method.energy"][1])


def test_what_is_asked_for_is_kept_and_printed(folder, capsys):
    (folder / "sweep.toml").write_text('keep = ["approach.virtual_mass", "fender.rated_energy"]\n' + SWEEP)
    assert cli.main(["sweep", "sweep.toml", "--plot", "sweep.png", "--csv"]) == 0
    assert (folder / "sweep.png").stat().st_size > 5000
    head = capsys.readouterr().out.splitlines()[0]
    assert head.startswith("case,keys.approach.speed,") and "fender.rated_energy [J]" in head
    (folder / "sweep.toml").write_text('keep = ["C_N"]\n' + SWEEP)
    assert cli.main(["sweep", "sweep.toml", "--fresh"]) == 2
    assert "keep: 'C_N' is not a quantity of this result; allowed: " in capsys.readouterr().err
    (folder / "sweep.toml").write_text('arguments = ["--plot", "one.png"]\n' + SWEEP)
    assert cli.main(["sweep", "sweep.toml", "--fresh"]) == 2
    assert "arguments contain --plot; allowed in a sweep: the flags of hakobune.berth" in capsys.readouterr().err


def test_a_sweep_that_stopped_is_taken_up(folder, monkeypatch, capsys):
    whole, done = run.one_case, []

    def stopping(*arguments):
        if len(done) == 1:
            raise KeyboardInterrupt
        done.append(arguments)
        return whole(*arguments)

    monkeypatch.setattr(run, "one_case", stopping)
    assert cli.main(["sweep", "sweep.toml"]) == 130
    monkeypatch.setattr(run, "one_case", whole)
    assert cli.main(["sweep", "sweep.toml"]) == 0
    assert "3 cases, 1 of them stored already" in capsys.readouterr().err
    found = numbers("sweep.h5")
    assert np.all(found["status"] == 0) and np.all(np.isfinite(found["results/method.C_M"]))


def test_a_ctrl_c_that_ends_the_command_of_a_case_ends_the_sweep_and_leaves_the_case_to_do(folder, monkeypatch, capsys):
    """A command tells it by its status, that of a scene which stops after its frequency too"""
    from hakobune.pipelines.berth import result

    whole = result.in_time

    def stopping(ship, meetings, speed):
        if speed > 0.12:
            raise KeyboardInterrupt
        return whole(ship, meetings, speed)

    monkeypatch.setattr(result, "in_time", stopping)
    assert cli.main(["sweep", "sweep.toml"]) == 130
    assert (
        "interrupted; finished cases are stored, and the same command continues with the others"
    ) in capsys.readouterr().err
    assert list(numbers("sweep.h5")["status"]) == [0, -1, -1]
    monkeypatch.setattr(result, "in_time", whole)
    assert cli.main(["sweep", "sweep.toml"]) == 0
    monkeypatch.setattr(one_case, "solved", lambda raw, study: (130, "", {}, {}))
    with pytest.raises(KeyboardInterrupt):
        one_case.one_case("solve", {}, "box.toml", {}, ())


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("approach.speed", "approach.sped", "approach.sped is unknown, speed may be meant; allowed: speed"),
        ("[0.1, 0.15, 0.2]", '["slow", "fast"]', "approach.speed is 'slow'; allowed: a number"),
    ],
)
def test_a_key_that_every_case_has_wrong_is_told_before_any_is_run(folder, capsys, old, new, said):
    (folder / "sweep.toml").write_text(SWEEP.replace(old, new))
    assert cli.main(["sweep", "sweep.toml"]) == 2
    assert said in capsys.readouterr().err and not (folder / "sweep.h5").exists()


def test_a_case_that_is_refused_is_kept_with_its_reason(folder, capsys):
    (folder / "sweep.toml").write_text(SWEEP.replace("0.1, 0.15, 0.2", "0.1, -1.0"))
    assert cli.main(["sweep", "sweep.toml"]) == 1
    assert "case 1: status 2" in capsys.readouterr().out
    (folder / "sweep.toml").write_text(SWEEP)
    assert cli.main(["sweep", "sweep.toml"]) == 2
    assert "belongs to another sweep; give --fresh" in capsys.readouterr().err


def test_a_latin_hypercube_has_one_sample_in_every_layer():
    vary = [VaryTable(key="a.b", first=0.0, last=1.0), VaryTable(key="c", first=-2.0, last=2.0)]
    table = SweepTable(command="berth", study="x", vary=vary, sampling="latin-hypercube", samples=20)
    points = np.array(cases(table))
    for column, (low, high) in zip(points.T, ((0, 1), (-2, 2)), strict=True):
        assert sorted(np.floor(20 * (column - low) / (high - low)).astype(int)) == list(range(20))
    assert cases(table) == cases(table)


def test_a_key_goes_to_its_place_and_nowhere_else():
    raw = {"a": [{"b": 1.0}, {"b": 2.0}], "c": {"d": 3.0}}
    assert put(put(raw, "a[1].b", 5.0), "c.e", 6.0) == {"a": [{"b": 1.0}, {"b": 5.0}], "c": {"d": 3.0, "e": 6.0}}
    assert raw["a"][1]["b"] == 2.0
    for key in ("x.y", "a[7].b", "c.d.e"):
        with pytest.raises(ValueError, match="has no table for the key"):
            put(raw, key, 1.0)


def test_a_star_puts_a_value_into_every_table_of_a_list():
    raw = {"rope": [{"hardening": 1.0, "name": "a"}, {"name": "b"}]}
    assert put(raw, "rope[*].hardening", 3.0)["rope"] == [
        {"hardening": 3.0, "name": "a"},
        {"hardening": 3.0, "name": "b"},
    ]
    assert raw["rope"][0]["hardening"] == 1.0
    for key in ("rope[*]", "line[*].length", "rope[*].of[*].b"):
        with pytest.raises(StudyError, match="the study has no table for the key"):
            put(raw, key, 1.0)
