"""`hakobune qtf` as a person runs it, and the studies that use what it stores."""

import os
import re
import shutil
from types import SimpleNamespace

import numpy as np
import pytest
from chain_study import chain_study
from result_views import check_views

import hakobune
from hakobune.bem.database import open_database
from hakobune.bem.second_order import first_order_waves, quadratic_forces, stored
from hakobune.bem.second_order.quadratic_forces import PARTS, QuadraticRun
from hakobune.bem.second_order.stored import read_forces
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap, tabulated
from hakobune.mooring.response import pair_levels
from hakobune.mooring.response.pair_levels import beside_newman, stored_pairs
from hakobune.mooring.response.sea_state import sea_state
from hakobune.mooring.response.slow_drift import HORIZONTAL
from hakobune.pipelines.cli import main
from hakobune.pipelines.qtf import report, running
from hakobune.pipelines.qtf.question import multiples

BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --panels 120 --gyration 15.55,29.44,32.28 --heading 0,180"
SWELL = Sea(jonswap(1.0, peak_period=11.0), np.pi)
STUDY = '[sea]\nspectrum = "jonswap"\nheight = 1.0\npeak_period = 11.0\ndirection_deg = 180.0\nqtf = "{}"\n'


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    path = tmp_path_factory.mktemp("qtf") / "box.h5"
    assert main([*BOX.split(), "--omega", "0.3:1.2:10", "--output", str(path)]) == 0
    words = "--omega 0.3:1.2:13 --heading 180 --difference 0.3 --level full"
    assert main(["qtf", str(path), *words.split()]) == 0
    return path


@pytest.fixture(scope="module")
def lacking(path, tmp_path_factory):
    """The same without pairs"""
    lacking = tmp_path_factory.mktemp("lacking") / "box.h5"
    assert main([*BOX.split(), "--omega", "0.3:1.2:10", "--output", str(lacking)]) == 0
    return lacking


def test_a_second_call_tells_what_is_stored_and_draws_it(path, capsys, tmp_path):
    before = path.read_bytes()
    assert main(["qtf", str(path), "--plot", str(tmp_path / "qtf.png")]) == 0
    said = capsys.readouterr().out
    assert "13 frequencies 0.3 to 1.2 rad/s, differences to 0.3" in said
    assert 1 < float(re.search(r"free-surface forcing around the body is (\S+) %", said)[1]) < 50
    assert 0.1 < float(re.search(r"estimated error of the panels.*surge (\S+) %", said)[1]) < 50
    assert float(re.search(r"the drift by pressure differs from it by (\S+) %", said)[1]) < 10
    assert path.read_bytes() == before and (tmp_path / "qtf.png").stat().st_size > 10_000


def test_views_of_stored_pairs_have_the_quantities_of_the_function(path, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "40")
    made = hakobune.qtf(path)
    check_views(made, ["qtf", str(path)], tmp_path / "qtf.h5", capsys)


@pytest.mark.parametrize(
    "words, said",
    [
        ("--omega 0.1:2:5", "within the stored 0.3 to 1.2"),
        ("--omega 0.4,0.5,0.9", "equal steps"),
        ("--omega 0.5", "two or more"),
        ("--omega 0.4:0.9:0", "two or more"),
        ("--omega 0.9:0.4:5", "increasing"),
        ("--omega 0.4:0.8:5 --difference 0.05", "(the frequency step) or more"),
        ("--heading 0:90:0", "one or more"),
        ("--difference -1", "--difference is -1"),
        ("--heading nan", "--heading is nan"),
        ("--plot x.doc", "suffix"),
        ("--level more", "--level is 'more'"),
        ("--method strip", "--method is 'strip'"),
        ("--method contour", "--method contour is given for"),
        ("--fixed --moored moor.toml", "--fixed and --moored"),
    ],
)
def test_wrong_questions_are_refused_in_one_line(path, words, said, capsys):
    assert main(["qtf", str(path), *words.split()]) == 2
    line = capsys.readouterr().err.strip().splitlines()[-1]
    assert line.startswith("hakobune qtf:") and said in line


def test_what_cannot_be_written_or_floats_without_inertia_is_refused_before_it_is_solved(
    coarse, tmp_path, capsys, monkeypatch
):
    path = shutil.copy(coarse[0], tmp_path / "box.h5")
    monkeypatch.setattr(running, "_solve", None)
    with monkeypatch.context() as patch:
        patch.setattr(type(open_database(path)), "inertia_matrix", None, raising=False)
        assert main(["qtf", str(path)]) == 2
    assert f"{path} has no inertia, which a floating body needs" in capsys.readouterr().err
    monkeypatch.setattr(os, "access", lambda place, mode: False)
    assert main(["qtf", str(path), "--fixed"]) == 2
    assert f"{path} cannot be written: no permission" in capsys.readouterr().err


def test_what_is_added_to_newman_makes_the_stored_force_of_a_pair(path):
    db = open_database(path)
    forces, pairs = read_forces(db).forces, stored_pairs(db, SWELL, "full")
    one, two = forces.omega[6:8], forces.omega[5:7]
    D, E = (db.reader.floating().drift(w, [np.pi])[:, 0] for w in (one, two))
    rule = np.where(D * E > 0, np.sign(D) * np.sqrt(np.abs(D * E)), 0.0)
    whole = forces.total[1, 5:7, 0, 0]
    added = pairs(one, two)
    scale = np.abs(whole[:, 0]).max()
    assert np.abs(added[:, HORIZONTAL] + rule - whole[:, HORIZONTAL])[:, 0].max() < 0.02 * scale
    assert not pairs(1.25, 1.2).any() and not pairs(1.2, 0.85).any()


def test_studies_take_the_level_they_ask_for(path, tmp_path, capsys):
    found = {}
    for level in ("newman", "bound-wave", "body", "full", "auto"):
        (tmp_path / "study.toml").write_text(STUDY.format(level))
        result = hakobune.response(tmp_path / "study.toml", path)
        pairs = result.quantities.get("drift.sigma_of_pairs")
        found[level] = None if pairs is None else (pairs.description, pairs.values[0])
    assert found["newman"] is None and found["auto"] == found["full"] != found["body"]
    assert found["body"][1] != found["bound-wave"][1]
    (tmp_path / "study.toml").write_text(STUDY.format("all"))
    assert main(["response", str(tmp_path / "study.toml"), "--database", str(path)]) == 2
    assert "sea.qtf is 'all'; allowed levels: newman, bound-wave, body, full, auto" in capsys.readouterr().err


def test_a_vertical_cylinder_has_them_by_contour_and_on_panels_when_asked(tmp_path, capsys):
    buoy, found = tmp_path / "buoy.h5", {}
    words = "buoy --radius 8 --draft 6 --depth 20 --panels 500 --gyration 4,4,5 --heading 0 --omega 0.5:1.1:7"
    assert main([*words.split(), "--output", str(buoy)]) == 0
    for method in ("auto", "panel", "contour"):
        asked = f"--omega 0.6:1.0:3 --difference 0.3 --level full --method {method}"
        assert main(["qtf", str(buoy), *asked.split()]) == 0
        said, stored = capsys.readouterr().out, read_forces(open_database(buoy))
        name = "panels" if method == "panel" else "contour method"
        assert f"estimated error of the {name}" in said and stored.method == ("contour", "panel")[name == "panels"]
        found[method] = [values[1, 0, 0, 0, 0] for values in (stored.forces.total, stored.errors)]
    assert found["auto"][0] == found["contour"][0] and found["contour"][1] < 1e-3 * abs(found["contour"][0])
    assert abs(found["panel"][0] / found["contour"][0] - 1) < 0.02


def test_a_body_on_its_lines_has_forces_of_its_own(path, tmp_path, capsys):
    other, study = shutil.copy(path, tmp_path / "box.h5"), tmp_path / "moor.toml"
    study.write_text(chain_study([30, 60]))
    question = ["--omega", "0.3:0.9:5", "--heading", "180", "--difference", "0.15"]
    words = ["qtf", str(other), *question, "--moored", str(study)]
    assert main(words) == 0
    assert f"moored ({study}) body" in capsys.readouterr().out
    held, free = (read_forces(open_database(p)).forces.total[0, :, 0, 0, 0].real for p in (other, path))
    assert 1e-5 < abs(held[4] / free[8] - 1) < 0.05  # at 0.9 rad/s, where lines are soft beside the waves


def test_what_is_not_stored_is_named_with_the_command_that_adds_it(path):
    db = open_database(path)
    with pytest.raises(ValueError, match=r"has no wave pairs towards 0°; .*--heading 0"):
        beside_newman(db, Sea(SWELL.spectrum, 0.0), "body")
    with pytest.raises(ValueError, match=r"pairs are stored from 0.3 to 1.2"):
        beside_newman(db, Sea(jonswap(1.0, peak_period=5.0), np.pi), "body")
    found, (said,) = beside_newman(db, Sea(SWELL.spectrum, 0.0), "auto")
    assert found.level == "bound-wave" and "has no wave pairs towards 0°" in said
    found, (said,) = beside_newman(db, Sea(jonswap(1.0, peak_period=5.0), np.pi), "auto")
    assert found is None and "uses newman at kh = 4." in said and "pairs are stored from 0.3 to 1.2" in said


def narrow(peak):
    """Sea from ahead, of 1 m, within the stored pairs: a triangle of 0.2 rad/s on either side of its peak"""
    return Sea(tabulated([peak - 0.2, peak, peak + 0.2], [0.0, 1 / 16 / 0.2, 0.0]), np.pi)


def test_what_is_taken_in_place_of_pairs_that_are_not_stored_is_told_as_left_out_with_size_and_command(path, lacking):
    """Swell has its bound waves, seas beyond kh = 1.5 Newman's rule; what the command stores is taken then"""
    whole, db = open_database(path), open_database(lacking)
    for peak, takes, size in (
        (0.6, "bound-wave", "0.9 to 1.6 times the complete ones"),
        (0.95, "newman at kh = 1.9", "0.7 to 1.2"),
    ):
        _, (said,) = beside_newman(db, narrow(peak), "auto")
        assert said.startswith("left out: the force of wave pairs") and "\n" not in said
        assert f'qtf = "auto" uses {takes}' in said and size in said
        assert said.endswith(f"'hakobune qtf {lacking} --heading 180 --level full' computes it")
        assert beside_newman(whole, narrow(peak), "auto")[1][0].startswith('qtf = "auto" uses full: ')


def test_the_whole_slow_surge_force_of_a_box_in_short_waves_is_as_far_from_newmans_as_is_told(path):
    """0.7 to 1.2 times, by its own spectrum from stored pairs; in swell of 11 s it is beyond that"""
    body, found = open_database(path).reader.floating(), {}
    for peak in (0.95, 0.57):
        pairs = stored_pairs(open_database(path), narrow(peak), "full")
        slow = sea_state(body, narrow(peak), 3600.0, bound=pairs).slow
        found[peak] = slow.sigma_of_pairs[0] / slow.sigma[0]
    assert 0.7 < found[0.95] < 1.2 < found[0.57], found


def test_a_forcing_of_the_surface_that_is_left_out_is_told_first_where_it_is_more_than_a_twentieth(path, monkeypatch):
    from hakobune.bem.second_order import stored

    db = open_database(path)
    with monkeypatch.context() as patch:
        patch.setattr(stored, "read_forces", lambda _: SimpleNamespace(share=0.16))
        assert pair_levels._surface_left_out(db, SWELL, "body") == (
            'left out: the free-surface forcing (qtf = "body"), about 16 % of the slow force of wave pairs; '
            f"'hakobune qtf {path} --heading 180 --level full' adds it",
        )
        assert pair_levels._surface_left_out(db, SWELL, "full") == ()
        patch.setattr(stored, "read_forces", lambda _: SimpleNamespace(share=0.04))
        assert not pair_levels._surface_left_out(db, SWELL, "body")[0].startswith("left out")


@pytest.mark.parametrize("low, high", [(0.3, 1.5), (0.31, 1.8), (1.9, 2.0), (0.05, 3.0)])
def test_frequencies_that_nobody_chose_are_multiples_of_their_step(low, high):
    found = multiples(low, high)
    step = found[1] - found[0]
    assert 41 <= len(found) <= 49 and found[-1] == pytest.approx(high) and low - 1e-9 <= found[0] < low + step
    assert found / step == pytest.approx(np.round(found / step), abs=1e-9)


QUESTION = ["--omega", "0.3:1.2:7", "--heading", "180", "--level", "full", "--difference"]


def by_twos(patch):
    """Blocks of two differences each, and no work that differences share, which few of them do without"""
    for module in (running, quadratic_forces):
        patch.setattr(module, "BLOCK", 2)
    patch.setattr(first_order_waves, "MANY", 100)


@pytest.fixture
def recorded(monkeypatch):
    """Blocks of both resolutions as they are solved, each stored at once"""
    solved, solve = [], QuadraticRun.solve
    by_twos(monkeypatch)
    monkeypatch.setattr(running, "EVERY", 0.0)
    monkeypatch.setattr(QuadraticRun, "solve", lambda run, block: (solved.append(block), solve(run, block))[1])
    return solved


@pytest.fixture(scope="module")
def coarse(tmp_path_factory):
    """Database of a box on 80 panels, and the same with pairs to 0.6 rad/s"""
    path, whole = (tmp_path_factory.mktemp("coarse") / name for name in ("box.h5", "whole.h5"))
    words = BOX.replace("--panels 120", "--panels 80").replace("0,180", "180")
    assert main([*words.split(), "--omega", "0.3,1.2", "--output", str(path)]) == 0
    shutil.copy(path, whole)
    with pytest.MonkeyPatch.context() as patch:
        by_twos(patch)
        assert main(["qtf", str(whole), *QUESTION, "0.6"]) == 0
    return path, whole


def equal(one, two):
    """Whether two databases have the same pairs, bit for bit, and errors to the last digits"""
    one, two = (read_forces(open_database(path)) for path in (one, two))
    assert one.asked is None and two.asked is None
    for part in PARTS:
        np.testing.assert_array_equal(getattr(one.forces, part), getattr(two.forces, part))
    np.testing.assert_array_equal(one.coarser, two.coarser)
    np.testing.assert_allclose(one.errors, two.errors, rtol=1e-9)
    return True


def test_a_run_that_was_ended_goes_on_from_the_differences_it_stored(coarse, tmp_path, capsys, monkeypatch, recorded):
    ended, solve = shutil.copy(coarse[0], tmp_path / "ended.h5"), QuadraticRun.solve

    def once(run, block):
        if len(recorded) == 2:  # both resolutions of the first differences
            raise KeyboardInterrupt
        return solve(run, block)

    with monkeypatch.context() as patch:
        patch.setattr(QuadraticRun, "solve", once)
        assert main(["qtf", str(ended), *QUESTION, "0.6"]) == 130
    assert (
        capsys.readouterr()
        .err.strip()
        .endswith("interrupted; finished pairs are stored, and the same command continues with the others")
    )
    db = open_database(ended)
    assert len(read_forces(db).forces.frequency) == 2 and read_forces(db).asked == pytest.approx(0.6)
    with pytest.raises(
        ValueError,
        match=r"come from an unfinished run; differences up to 0.15 of 0.6 rad/s are stored; "
        r"'hakobune qtf .*' continues it",
    ):
        stored_pairs(db, SWELL, "full")
    less = shutil.copy(ended, tmp_path / "less.h5")
    assert main(["qtf", str(ended)]) == 0
    assert recorded[2][0] == 2 and equal(ended, coarse[1])
    before = len(recorded)
    assert main(["qtf", str(less), *QUESTION, "0.15"]) == 0  # of which all is there
    assert len(recorded) == before and read_forces(open_database(less)).asked is None


def test_the_share_of_the_surface_is_estimated_once(coarse, tmp_path, monkeypatch, recorded):
    path, share, asked = shutil.copy(coarse[0], tmp_path / "box.h5"), running.surface_share, []
    monkeypatch.setattr(running, "surface_share", lambda *question: (asked.append(question), share(*question))[1])
    words = ["qtf", str(path), *QUESTION[:4], "--difference", "0.45"]
    with monkeypatch.context() as patch:
        patch.setattr(running.QuadraticForces, "joined", _ended_at_the_second(running.QuadraticForces.joined))
        assert main(words) == 130
    assert main(words) == 0 and len(asked) == 1 and read_forces(open_database(path)).share > 0


def _ended_at_the_second(joined):
    def once(several):
        if len(several) > 1:
            raise KeyboardInterrupt
        return joined(several)

    return once


def test_a_larger_difference_adds_to_what_is_stored(coarse, tmp_path, recorded):
    wider = shutil.copy(coarse[0], tmp_path / "wider.h5")
    for difference in ("0.3", "0.6"):
        assert main(["qtf", str(wider), *QUESTION, difference]) == 0
    first, second = [0, 0, 2, 2], [2, 2, 4, 4]  # of three differences two are a whole block
    assert [block[0] for block in recorded] == [*first, *second] and equal(wider, coarse[1])


def test_progress_tells_frequencies_pairs_and_the_time_left(monkeypatch, capsys):
    now = iter([0.0, 2.0, 6.0, 200.0])
    monkeypatch.setattr(running.time, "monotonic", lambda: next(now))
    monkeypatch.setattr(running.sys.stderr, "isatty", lambda: True)
    told = running._Told(2)
    for run, part, done, of in ((0, "frequencies", 1, 1), (0, "pairs", 20, 100), (1, "pairs", 20, 100)):
        told.of(run)(part, done, of)
    lines = re.split("[\r\n]", capsys.readouterr().err)
    assert [line.removeprefix("\x1b[K") for line in lines if line] == [
        "1/2 frequencies",
        "20/200 pairs",
        "40/200 pairs, 32 s left",
    ]
    told.of(0)("pairs", 40, 100)
    assert (
        "60/200 pairs, 11 min 33 s left; fewer frequencies (--omega) or a smaller --difference"
        in capsys.readouterr().err
    )


@pytest.mark.parametrize("since, lines", [(29.0, []), (31.0, ["40/100 pairs, 46 s left"])])
def test_progress_is_told_in_a_log_too_every_half_minute(since, lines, monkeypatch, capsys):
    """40 of 100 pairs, 40 of them in 31 s: 46.5 s for 60 more"""
    now = iter([100.0, 100.0 + since])
    monkeypatch.setattr(running.time, "monotonic", lambda: next(now))
    told = running._Told(1)
    for done in (0, 40):
        told.of(0)("pairs", done, 100)
    assert capsys.readouterr().err.splitlines() == lines


def test_a_question_that_is_stored_is_not_solved_again_and_differences_end_with_the_band(path, monkeypatch):
    before = path.read_bytes()
    monkeypatch.setattr(running, "_solve", None)
    assert main(["qtf", str(path), *["--omega", "0.3:1.2:13", "--heading", "180", "--difference", "0.3"]]) == 0
    assert main(["qtf", str(path), *["--omega", "0.3:0.525:4", "--heading", "180,540", "--difference", "9"]]) == 0
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    "panel, says",
    [
        (4.0, "the difference falls with more panels, at best as one over their number: 1200 or more for the limit"),
        (8.5, "3 panels to a wave length; use smaller panels in the scene, or --omega up to that frequency"),
    ],
)
def test_drift_by_pressure_that_is_off_on_panels_too_large_for_the_waves_is_told_with_the_waves_they_carry(panel, says):
    """A wave of 25.5 m, three panels of 8.5 m, has ω = √(2πg/25.5) = 1.554 rad/s in deep water; of 12 m 2.27 rad/s"""
    forces = SimpleNamespace(
        added=np.full((2, 1, 1, 3), 0.06), headings=[0.0], squares=np.ones((1, 2, 1, 1, 6), complex), kind=None,
        omega=np.array([0.5, 2.25]),
    )  # fmt: skip
    flat = np.zeros((2, 4, 3))
    mesh = SimpleNamespace(sizes=np.array([1.0, panel]), total=1000, vertices=flat, flat_vertices=flat)
    db = SimpleNamespace(mesh=mesh, water_depth=500.0, gravity=9.80665)
    (said,) = report.failures(SimpleNamespace(forces=forces), db)
    assert said.startswith("FAILS: mean drift by pressure differs") and "6 % of the largest, limit 5 %" in said
    assert says in said
    db.attributes = {"imported": "wamit: a.1"}  # it has no scene
    (said,) = report.failures(SimpleNamespace(forces=forces), db)
    assert says.replace("in the scene", "in the mesh, and import it (--mesh)") in said


@pytest.mark.parametrize("gap, used", [(0.24, True), (0.26, False)])
def test_pairs_that_fail_their_check_are_told_everywhere_and_left_out_by_auto_above_a_quarter(
    path, gap, used, monkeypatch, tmp_path, capsys
):
    monkeypatch.setattr(stored, "diagonal_gap", lambda forces: gap)
    number, db = f"differs from the far-field drift by {100 * gap:g} % of the largest, limit 5 %", open_database(path)
    found, said = beside_newman(db, SWELL, "auto")
    assert (getattr(found, "level", "bound-wave") == "full") == used and sum(number in line for line in said) == 1
    assert ("fail their check and are not used" in " ".join(said)) != used
    found, said = beside_newman(db, SWELL, "full")
    assert found.level == "full" and said[0].startswith('qtf = "full" uses wave pairs that fail') and number in said[0]
    assert main(["check", str(path)]) == 1
    assert number in " ".join(capsys.readouterr().out.split())
    study = tmp_path / "study.toml"
    study.write_text(STUDY.format("auto"))
    main(["response", str(study), "--database", str(path)])
    printed = capsys.readouterr()
    assert number in " ".join((printed.out + printed.err).split())
    assert main(["qtf", str(path)]) == 1
    printed = " ".join(capsys.readouterr().out.split())
    assert number in printed and "there is no estimated error" in printed
