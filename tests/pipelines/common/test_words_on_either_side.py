"""Remarks, findings and notes of several commands on either side of their limits, with their numbers by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.passing.passage import Track
from hakobune.pipelines import doctor
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design.kinds.changes import ways
from hakobune.pipelines.downtime import report as downtime_report
from hakobune.pipelines.downtime.result import _notes as of_record
from hakobune.pipelines.line_dynamics import effort as of_line
from hakobune.pipelines.passing.result import _findings as of_passage
from hakobune.pipelines.passing.result import _notes as of_hulls
from hakobune.pipelines.response import effort as of_responses
from hakobune.pipelines.single_point.quantities import cycle_of
from hakobune.pipelines.solve import adaptive, large, remarks
from hakobune.pipelines.solve import report as of_solve
from hakobune.pipelines.sweep.command import _findings as of_cases


@pytest.mark.parametrize("density, told", [(899.9, True), (900.0, False), (1300.0, False), (1300.1, True)])
def test_water_is_from_fresh_and_warm_to_the_dead_sea(density, told):
    said = list(remarks._density_remarks(density))
    assert (
        said
        == [f"density {density:g} kg/m³ is not a density of water, 900 to 1300 kg/m³; check its unit (--density)"]
        * told
    )


@pytest.mark.parametrize("gravity, told, feet", [
    (9.69, True, False), (9.7, False, False), (9.9, False, False), (9.91, True, False), (31.79, True, False),
    (31.8, True, True), (32.174, True, True), (32.5, True, True), (32.51, True, False),
])  # fmt: skip
def test_gravity_is_that_of_the_earth_and_in_feet_it_is_said_to_be(gravity, told, feet):
    said = " ".join(remarks._gravity_remarks(gravity))
    assert said.startswith(f"gravity {gravity:g} m/s² is not gravity on the earth, 9.7 to 9.9 m/s²") == told
    assert (": this is the value in ft/s²" in said) == feet


def check(name, largest, limit=0.01, exceeding=0):
    return of_solve.Check(name, largest, 0.8, limit, exceeding)


@pytest.mark.parametrize("largest, own_panels, told", [(0.0099, False, False), (0.0101, False, True),
                                                       (0.249, True, False), (0.251, True, True)])  # fmt: skip
def test_laws_are_broken_beyond_the_tolerance_or_a_quarter_with_panels_of_ones_own(
    largest, own_panels, told, monkeypatch
):
    """Errors that are estimated are no laws"""
    checks = [check("energy", largest), check("estimated_error", 9.0), check("damping", 9.0), check("reciprocity", 0.0)]
    monkeypatch.setattr(of_solve, "stored_checks", lambda db: checks)
    limit = 0.25 if own_panels else 0.01
    wanted = (
        f"checks failed: energy is broken by {largest:.2g} at ω = 0.8 rad/s, limit {limit:.2g}; either the mesh or "
        f"the method"
    )
    said = of_solve.failed_laws(None, own_panels)
    assert said.startswith(wanted) if told else said == ""


@pytest.mark.parametrize("exceeding, told", [(0, False), (2, True)])
def test_an_estimated_error_above_the_tolerance_says_where(exceeding, told, monkeypatch):
    one = check("estimated_error", 0.034, exceeding=exceeding)
    monkeypatch.setattr(of_solve, "stored_checks", lambda db: [check("energy", 1.0), one])
    said = of_solve.missed_tolerance(SimpleNamespace(omega=np.arange(7), header=SimpleNamespace(scene="")))
    words = (
        "the estimated error is 0.034 at ω = 0.8 rad/s, above the tolerance 0.01 at 2 of 7 frequencies; give --panels"
    )
    assert said.startswith(words) if told else said == ""


def test_frequencies_of_a_band_are_counted_with_both_its_ends():
    """0.5 and 1.5 are of the band from 0.5 to 1.5, 0.49 and 1.51 are not; errors and tolerance in per cent"""
    scene = SimpleNamespace(waves=SimpleNamespace(band=SimpleNamespace(first=0.5, last=1.5)), accuracy=0.02)
    db = SimpleNamespace(omega=np.array([0.49, 0.5, 1.0, 1.5, 1.51]), names={"added_mass", "rao"})
    said = adaptive._text(scene, db, math.nan)
    assert said == "3 frequencies from 0.5 to 1.5 rad/s, too few to estimate the error between frequencies"
    said = adaptive._text(scene, db, 0.013)
    assert "error of coefficients between them 1.3 % (tolerance 2 %), and more for motions" in said
    assert "drift" not in said
    db.names = {"added_mass", "excitation_force", "rao", "drift_force"}
    assert "error of coefficients and forces between them 1.3 %" in adaptive._text(scene, db, 0.013)
    assert adaptive._text(scene, db, 0.013).endswith(", and more for motions and drift")
    db.names = {"added_mass", "Froude_Krylov_force"}  # which are exact
    assert adaptive._text(scene, db, 0.013).endswith("error of coefficients between them 1.3 % (tolerance 2 %)")


def test_a_database_takes_its_numbers_twice_where_errors_are_stored_too(monkeypatch):
    """Added mass: 3 × 6 × 6 × 8 bytes, and as many of its errors; forces: 3 × 2 × 6 × 16, with theirs"""
    found = []
    monkeypatch.setattr(large, "check_memory", lambda what, needed, *more: found.append((what, needed)))
    header = SimpleNamespace(bodies=[], modes=[], theta=np.zeros(4), mesh=SimpleNamespace(total=10))
    for names in (["added_mass"], ["added_mass", "excitation_force"], ["kochin_diffraction"]):
        large.check_database(header, 3, 2, names)
    assert found[0][0] == "3 frequencies and 2 headings need"
    masses, both, waves = (needed / large.COPIES for _, needed in found)
    assert (masses, both - masses, waves) == (2 * 3 * 36 * 8, 2 * 3 * 2 * 6 * 16, 3 * 2 * 4 * 16)


@pytest.mark.parametrize("count, more", [(0, 0), (5, 0), (6, 1), (9, 4)])
def test_five_cases_of_a_sweep_are_named_and_the_rest_are_counted(count, more):
    outcome = SimpleNamespace(failed=[(i, 2, "no ship") for i in range(count)], lost=(0, ""))
    said = list(of_cases(outcome, "out.h5"))
    assert len(said) == min(count, 5) + bool(more)
    if count:
        assert said[0].endswith("case 0: status 2; no ship")
    if more:
        assert said[5].endswith(f"{more} more cases have a status above 0; out.h5 has their messages")
    outcome.lost = 3, "a process ended"
    last = list(of_cases(outcome, "out.h5"))[-1]
    assert last.endswith("3 cases were not run, a process ended; run the same command to continue")


def test_folders_of_older_installations_are_those_with_our_modules(tmp_path, monkeypatch):
    monkeypatch.setattr(doctor.sysconfig, "get_path", lambda name: str(tmp_path))
    (tmp_path / "bem").mkdir()  # of another project
    assert doctor._left_over() == ""
    (tmp_path / "mooring").mkdir()
    (tmp_path / "mooring" / "catenary.py").touch()
    said = f"mooring in {tmp_path} are from an older installation; remove these folders"
    assert doctor._left_over() == said


def test_a_mesher_that_cannot_be_loaded_is_said_in_one_line(monkeypatch):
    def broken():
        raise OSError("libGLU.so.1:\n  no such file")

    monkeypatch.setattr("hakobune.meshing.gmsh_session.session", broken)
    assert doctor._gmsh() == "gmsh cannot be loaded, so that no meshes can be made: libGLU.so.1: no such file"


def test_the_cache_of_kernels_is_told_with_its_size(tmp_path, monkeypatch, capsys):
    """1.6 MB in two folders are 2 MB; a folder that is not there yet is that of the nearest above it"""
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "kernel").write_bytes(b"0" * 800_000)
    monkeypatch.setattr("hakobune.bem.kernels.jit.cache_folder", lambda *_: tmp_path / "one")
    assert doctor._cache() == "" and f"{tmp_path}, 2 MB compiled (HAKOBUNE_CACHE moves it)" in capsys.readouterr().out
    monkeypatch.setattr(doctor.os, "access", lambda place, _: False)
    assert doctor._cache() == (
        f"{tmp_path} cannot be written, so kernels are compiled at every start; set HAKOBUNE_CACHE to a writable folder"
    )


@pytest.mark.parametrize("years, told", [(4, True), (5, False)])
def test_four_years_have_no_interval_and_a_record_is_told_with_its_length(years, told):
    """Rows of 3 h: 365.25 · 8 a year"""
    time = np.datetime64("2001-01-01T00") + np.timedelta64(3, "h") * np.arange(years * 2922)
    year = time.astype("datetime64[Y]").astype(int)
    said = list(of_record(SimpleNamespace(time=time, hours=3.0, year=year[year < year[0] + years])))
    assert said[0].startswith(f"record: {years * 2922} rows of 3 h, {years} years, 2001-01-01T00 to ")
    assert (said[1:] == ["no intervals are given for fewer than 5 years"]) is told


class Found(dict):
    """Quantities by name, with labels and limits"""

    labels = {  # noqa: RUF012
        "operation": SimpleNamespace(values=["work", "stay"]),
        "limit": SimpleNamespace(values=["work: surge", "work: wind", "stay: wind"]),
    }
    detail = SimpleNamespace(limits=[SimpleNamespace(operation=i) for i in (0, 0, 1)])


def test_the_line_of_an_operation_names_what_stops_it_most():
    found = Found({
        "downtime.hours": [120.0, 0.0], "downtime.share": [0.0137, 0.0], "cause.hours": [50.0, 100.0, 0.0],
        "downtime.hours_low": [90.0, math.nan], "downtime.hours_high": [150.0, math.nan],
    })  # fmt: skip
    assert downtime_report._verdict(found, 0) == {
        "name": "work",
        "text": "is down 120 h a year, 1.37 % of the time, 90 % interval 90 to 150 h; "
        "the main cause is wind with 100 h.",
    }
    assert downtime_report._verdict(found, 1)["text"] == "is down 0 h a year, 0 % of the time."


def test_responses_are_eighteen_of_a_body_and_thirteen_of_each_point(monkeypatch):
    """At as many headings as a spread sea takes, 36 of each direction and 360 at most; in the states that occur"""
    asked = {}
    monkeypatch.setattr(of_responses, "check_memory", lambda what, needed, *_: asked.update(what=what, memory=needed))
    monkeypatch.setattr(of_responses, "check_seconds", lambda what, needed, *_: asked.update(seconds=needed))
    sea, two = SimpleNamespace(spreading=None), [1, 2]
    of_responses.check_effort(SimpleNamespace(points=two, sea=sea, climate=None))
    assert asked["what"] == "44 responses need"
    one = asked["memory"]
    assert one == pytest.approx(44 * of_responses.BYTES) and asked["seconds"] == pytest.approx(2 * 0.04)
    of_responses.check_effort(SimpleNamespace(points=two, sea=SimpleNamespace(spreading="cosine:4"), climate=None))
    assert asked["memory"] == pytest.approx(36 * one)
    scatter = SimpleNamespace(probability=np.array([[0.2, 0.0], [0.3, 0.0], [0.0, 0.5]]))
    for directions, headings in ((2, 72), (11, 360)):
        climate = SimpleNamespace(spreading="cosine:4", directions=[0] * directions)
        of_responses.check_effort(SimpleNamespace(points=two, sea=None, climate=climate), scatter)
        assert asked["what"] == f"44 responses in {3 * directions} sea states need"
        assert asked["memory"] == pytest.approx(headings * one + 60 * 44 * 3 * directions)
        assert asked["seconds"] == pytest.approx(0.08 + 44 * directions * (2 * 1.5e-4 + 3 * 3e-7))


def test_frames_of_a_line_are_those_given_or_twenty_a_cycle_within_bounds():
    def count(frames=None, duration=100.0, cycle=None):
        course = SimpleNamespace(duration=duration, cycle=cycle)
        return of_line.frames_of(SimpleNamespace(frames=frames), course)

    assert [count(2), count(100_000), count(), count(cycle=10.0), count(cycle=8.0), count(cycle=0.5)] == [
        2, 100_000, 201, 201, 251, 2001,
    ]  # fmt: skip
    for frames in (1, 100_001):
        with pytest.raises(StudyError, match=f"frames is {frames}; allowed: 2 to 100000"):
            count(frames)


@pytest.mark.parametrize("tolerance, taken", [(9e-9, False), (1e-8, True), (0.1, True), (0.11, False)])
def test_a_line_is_followed_to_tolerances_above_rounding(tolerance, taken, monkeypatch):
    """2 kB for each element of all segments, where their number is given"""
    asked = []
    monkeypatch.setattr(of_line, "check_memory", lambda what, needed, *_: asked.append((what, needed)))
    study = SimpleNamespace(tolerance=tolerance, segments=[SimpleNamespace(elements=n) for n in (30, None, 12)])
    if taken:
        of_line.check_finest(study)
        assert asked == [("42 elements need", 84e3)]
    else:
        with pytest.raises(StudyError, match=f"tolerance is {tolerance:g}; allowed: 1e-08 to 0.1"):
            of_line.check_finest(study)


def passage(method="wang", left=0.0, draft=10.0, depth=20.0, speed=5.0, shape="ship"):
    study = SimpleNamespace(method=method, moored=SimpleNamespace(shape=shape, draft=draft, rotation_center=None),
                            water=SimpleNamespace(depth=depth), panels=100)  # fmt: skip
    track = Track(100.0, speed)
    said = list(of_passage(study, track, SimpleNamespace(left=left), None, None))
    return said, list(of_hulls(study, track, 61.25))


@pytest.mark.parametrize("method, draft, shape, told", [
    ("wang", 10.0, "ship", False), ("wang", 10.1, "ship", True), ("wang", 18.0, "mesh", False),
    ("panels", 18.0, "ship", False),
])  # fmt: skip
def test_slender_ships_leave_out_that_one_blocks_more_than_half_of_the_depth(method, draft, shape, told):
    said, _ = passage(method, draft=draft, shape=shape)
    words = f"the moored ship blocks {100 * draft / 20:.0f} % of the depth, which slender-ship theory does not include"
    assert any(line.startswith(words) for line in said) is told


@pytest.mark.parametrize("method", ["panels", "wang"])
def test_what_a_passage_is_of_is_noted(method):
    """5 m/s in 20 m: Fₕ = 5/√(9.80665 · 20) = 0.36"""
    *_, notes = passage(method)
    assert notes[0].startswith("both hulls lie under a rigid surface and have about 100 panels") == (method == "panels")
    assert (
        notes[1]
        == "the ship moves at 5 m/s through the water, with 61.25 m between the sides; the depth Froude number is 0.36"
    )
    assert notes[2].endswith("rotation_center [0, 0, 0]")


@pytest.mark.parametrize("speed, told", [(5.82, ""), (5.85, "0.42"), (10.4, "0.74"), (10.5, "0.75")])
def test_water_that_is_shallow_for_the_speed_is_told(speed, told):
    """1/√(1 − Fₕ²), Fₕ² = v²/gh: 1.1 at 5.83 m/s in 20 m of water; 1.5 at 10.44 m/s, where it fails"""
    said = [line for line in passage("panels", speed=speed)[0] if "depth Froude number" in line]
    assert len(said) == bool(told)
    if told:
        assert f"depth Froude number {told}: " in said[0] and said[0].startswith("FAILS") == (speed == 10.5)
        assert f"about {1 / math.sqrt(1 - speed**2 / (20 * 9.80665)):.2f} times" in said[0]


def test_changes_of_a_study_are_of_what_it_has():
    """Ropes stronger by tenths up to twice, two at each place; up to three lines more at a buoy or at each corner"""
    ropes = ways({"rope": [{"name": "head", "breaking_load_kN": 1000.0, "tail_breaking_load_kN": 800.0}]})
    assert [one.words for one in ropes["size"]][::9] == [
        "ropes of 1100 kN breaking load",
        "ropes of 2000 kN breaking load",
    ]
    assert ropes["size"][-1].study["rope"][0]["tail_breaking_load_kN"] == 1600.0
    (twice,) = ropes["number"]
    assert twice.words == "2 ropes, two at each place"
    assert [rope["name"] for rope in twice.study["rope"]] == ["head", "head, second"]
    assert "less pretension" not in ropes and "more pretension" not in ropes
    buoy = ways({"mooring": {"count": 6, "top_tension_kN": 100.0}})
    assert [one.words for one in buoy["number"]] == [f"{n} lines at the buoy" for n in (7, 8, 9)]
    slack, tight = (buoy[f"{word} pretension"] for word in ("less", "more"))
    assert all(one.study["mooring"]["top_tension_kN"] < 100 for one in slack)
    assert all(one.study["mooring"]["top_tension_kN"] > 100 for one in tight)
    assert all(f"a pretension of {one.study['mooring']['top_tension_kN']:.4g} kN" == one.words for one in slack + tight)
    corner = ways({"spreads": [{"corner_headings_deg": [45.0], "pretension_tonf": 10.0}]})
    assert [one.study["spreads"][0]["corner_headings_deg"] for one in corner["number"]] == [
        [35.0, 55.0], [35.0, 45.0, 55.0], [35.0, 41.67, 48.33, 55.0],
    ]  # fmt: skip
    assert corner["number"][1].words == "3 lines at each corner"


def test_what_large_problems_take_is_told_by_their_phases():
    """Before the first frequency as long as one band takes, and again for each limit of the frequency"""
    assert large._times(SimpleNamespace(seconds=90.0), 0) == ", about 1 min 30 s before the first frequency"
    both = large._times(SimpleNamespace(seconds=90.0), 2)
    assert both == ", about 1 min 30 s before the first frequency, about 3 min 00 s for added mass at the limits"


@pytest.mark.parametrize(
    "processes, words", [(1, "panels (--panels)"), (2, "panels (--panels) or fewer processes (--ex")]
)
def test_panels_that_do_not_fit_are_refused_with_the_ways_out(processes, words, monkeypatch):
    asked = []
    monkeypatch.setattr(large, "check_memory", lambda *given: asked.append(given))
    large._check_memory(5000, 7e9, processes)
    ((what, memory, way_out, _),) = asked
    assert (what, memory) == ("5000 panels need", 7e9) and way_out.startswith(f"give fewer {words}")


def test_a_cycle_is_told_by_its_pulls_and_its_largest_line():
    """Two hawsers that pull 3 and 4 kN together 5 kN, least where they pull 0.6 and 0.8"""
    pulls, lines = np.array([[3e3, 4e3], [600.0, 800.0]]), np.array([[1e4, 2e4], [5e4, 1e3]])
    cycle = SimpleNamespace(amplitude=0.3, middle=math.pi, period=900.0, hawser=pulls, lines=lines,
                            states=np.zeros((2, 6)),
                            time=np.zeros(2), places=np.zeros((2, 2)))  # fmt: skip
    made, _ = cycle_of(SimpleNamespace(cycle=cycle))
    numbers = {name.split(".")[1]: float(one.values) for name, one in made.items() if one.values.ndim == 0}
    assert numbers["amplitude"] == 0.3 and numbers["period"] == 900.0
    assert (numbers["least_pull"], numbers["largest_pull"], numbers["largest_line"]) == pytest.approx((1e3, 5e3, 5e4))
    assert cycle_of(SimpleNamespace(cycle=None)) == ({}, {})
