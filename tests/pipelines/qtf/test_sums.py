"""`hakobune qtf --sum` as a person runs it: stored beside the differences, told, drawn, exported, gone on with."""

import shutil

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.bem.second_order.kinds import SUM
from hakobune.bem.second_order.stored import read_forces
from hakobune.pipelines.cli import main
from hakobune.pipelines.qtf import running

BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --panels 120 --gyration 15.55,29.44,32.28 --heading 0,40"
QUESTION = "--sum --omega 0.3:0.6:4 --heading 0,40 --highest 1.2"


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    path = tmp_path_factory.mktemp("sums") / "box.h5"
    assert main([*BOX.split(), "--omega", "0.3:0.9:7", "--output", str(path)]) == 0
    for words in ("--omega 0.3:0.6:4 --difference 0.1 --heading 0", QUESTION):
        assert main(["qtf", str(path), *words.split()]) == 0
    return path


def test_they_stand_beside_the_differences_with_errors_and_all_parts(path, capsys, tmp_path):
    db = open_database(path)
    stored, slow = read_forces(db, SUM), read_forces(db)
    assert slow.forces.frequency[-1] == pytest.approx(0.1) and stored.asked is None
    assert stored.forces.frequency == pytest.approx(np.arange(0.6, 1.25, 0.1)) and stored.forces.surface is not None
    for n in range(4):  # a frequency with itself, in both orders of the headings
        own = stored.forces.total[2 * n, n]
        np.testing.assert_allclose(own, own.swapaxes(0, 1), atol=1e-9 * np.abs(own).max())
    known = np.isfinite(stored.forces.total)
    assert np.all(stored.errors[known] >= 0) and np.median(stored.errors[known]) > 0
    before = path.read_bytes()
    assert main(["qtf", str(path), "--sum", "--plot", str(tmp_path / "sum.png")]) == 0
    said = capsys.readouterr().out
    assert "sums to 1.2 rad/s, 2 headings" in said and "+ surface" in said and "estimated error of the panels" in said
    assert path.read_bytes() == before and (tmp_path / "sum.png").stat().st_size > 10_000


def test_they_are_exported_and_come_back(path, tmp_path, capsys):
    assert main(["export", str(path), "--to", "wamit", "--output", str(tmp_path / "box")]) == 0
    assert (tmp_path / "box.12d").exists() and (tmp_path / "box.12s").exists()
    again = tmp_path / "again.h5"
    words = ["import", str(tmp_path / "box.1"), "--from", "wamit", "--depth", "20", "--output", str(again)]
    assert main(words) == 0 and "qtf, qtf_sum" in capsys.readouterr().out
    found, sums = (read_forces(open_database(place), SUM).forces for place in (again, path))
    np.testing.assert_allclose(found.total, sums.total, rtol=1e-4, atol=1e-5 * np.nanmax(np.abs(sums.total)))


def test_a_run_that_was_ended_goes_on_and_gives_the_same(path, tmp_path, monkeypatch):
    place, whole = shutil.copy(path, tmp_path / "box.h5"), read_forces(open_database(path), SUM).forces
    words = ["qtf", str(place), *QUESTION.split(), "--fresh"]
    monkeypatch.setattr(running, "EVERY", 0.0)
    monkeypatch.setattr(running, "BLOCK", 2)
    monkeypatch.setattr("hakobune.bem.second_order.quadratic_forces.BLOCK", 2)
    write, written = running.write_forces, []

    def ended(*arguments):
        write(*arguments)
        written.append(arguments)
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(running, "write_forces", ended)
        assert main(words) == 130
    begun = read_forces(open_database(place), SUM)
    assert begun.asked == pytest.approx(1.2) and len(begun.forces.frequency) == 2
    assert main(["qtf", str(place), "--sum"]) == 0
    found = read_forces(open_database(place), SUM).forces
    np.testing.assert_allclose(found.total, whole.total, atol=1e-9 * np.nanmax(np.abs(whole.total)))  # other blocks


def test_the_largest_sum_is_the_one_whose_waves_the_panels_carry(path, tmp_path, capsys):
    place = shutil.copy(path, tmp_path / "box.h5")
    assert main(["qtf", str(place), "--sum", "--omega", "0.5:0.9:3", "--heading", "0", "--level", "body"]) == 0
    said, forces = capsys.readouterr().out, read_forces(open_database(place), SUM).forces
    assert ("left out: the free-surface forcing") in said and forces.surface is None
    assert 1.0 <= forces.frequency[-1] < 1.8 and f"sums to {forces.frequency[-1]:.3g}" in said
    size = open_database(place).mesh.sizes.max()
    k = (forces.frequency[-1] + 0.2) ** 2 / 9.80665  # of the next sum, in deep water
    assert 2 * np.pi / k < 3 * size * 1.01


@pytest.mark.parametrize(
    "words, said",
    [
        ("--sum --difference 0.2", "--difference is given; it can be used without --sum"),
        ("--highest 1.0", "--highest is given; it can be used with --sum"),
        ("--sum --highest 0.3", "--highest is 0.3; allowed: 0.6 rad/s (twice the lowest frequency) or more"),
        ("--sum --highest nan", "--highest is nan"),
        ("--sum --level auto", "--level is 'auto'; allowed: body, full"),
    ],
)
def test_wrong_questions_are_refused_in_one_line(path, words, said, capsys):
    assert main(["qtf", str(path), *words.split()]) == 2
    line = capsys.readouterr().err.strip().splitlines()[-1]
    assert line.startswith("hakobune qtf:") and said in line
