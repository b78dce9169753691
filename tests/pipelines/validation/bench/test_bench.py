"""The bench: its references, its measure of error, its meshes and clocks for other programs, its command."""

import csv
import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from bench.solver_references import exact, extrapolated

from hakobune.bem.checks import ERROR_ORDER
from hakobune.meshing.panels import PanelMesh
from hakobune.pipelines.cli import main
from hakobune.pipelines.validation.bench.cases import CASES
from hakobune.pipelines.validation.bench.found import best, equal_panels, least_ms, one_thread_and_two
from hakobune.pipelines.validation.bench.measure import Row, measured
from hakobune.pipelines.validation.bench.meshes import part
from hakobune.pipelines.validation.bench.peers import repeated
from hakobune.pipelines.validation.bench.plan import PROGRAMS, Job, plan
from hakobune.pipelines.validation.bench.references import Coefficients, compared, error, references
from hakobune.pipelines.validation.bench.run import bench

CYLINDERS = [case for case in CASES.values() if case.shape == "buoy"]
BOXES = [case for case in CASES.values() if case.shape == "box"]
CONTOUR = Job("cylinder-30", "hakobune", "contour", 1e-3, 1, {"method": "contour"})
OURS = {"hakobune": sys.executable}


def known(case):
    """The reference as a result"""
    values, n = references()[case.name], len(case.omega)
    A, B = np.zeros((2, n, 6, 6))
    for name, value in values.items():
        if name[0] in "AB":
            (A if name[0] == "A" else B)[:, int(name[1]) - 1, int(name[2]) - 1] = value
    return Coefficients(A, B, np.stack([values[f"X{i}"] for i in range(1, 7)], axis=1))


@pytest.mark.parametrize("case", CYLINDERS, ids=lambda case: case.name)
def test_references_of_cylinders_are_exact(case):
    """Against the exact solution with more functions than the table was made with"""
    found = exact(case, terms=28, modes=200)
    assert error(case, found).value < 1e-6


@pytest.mark.parametrize("case", BOXES, ids=lambda case: case.name)
def test_references_of_boxes_are_where_panels_converge_to(case):
    """The panel method shares nothing with the contour method; 936 panels carried on to infinitely many"""
    i = 3
    values, carried = references()[case.name], extrapolated(case, omegas=(case.omega[i],))
    for name, largest in compared(case, values).items():
        assert abs(carried[name][0] - values[name][i]) < 1e-3 * largest, name


@pytest.mark.parametrize("case", CASES.values(), ids=lambda case: case.name)
def test_references_are_reciprocal_and_dissipate(case):
    values = references()[case.name]
    for letter in "AB":
        for pair in ("15", "24"):
            one, two = values[letter + pair], values[letter + pair[::-1]]
            assert np.abs(one - two).max() < 1e-6 * np.abs(one).max()
    assert all(values[f"B{i}{i}"].min() >= 0 for i in range(1, 7))


@pytest.mark.parametrize("case", CASES.values(), ids=lambda case: case.name)
def test_the_error_of_a_coefficient_is_relative_to_its_largest_value(case):
    right = known(case)
    assert error(case, right).value == 0
    largest = np.abs(right.A[:, 2, 2]).max()
    wrong = right.A.copy()
    wrong[1, 2, 2] -= 0.03 * largest
    found = error(case, right._replace(A=wrong))
    assert found.value == pytest.approx(0.03) and found.of == "A33"
    turned = error(case, right._replace(X=right.X * np.exp(0.1j)))
    assert turned.value == pytest.approx(2 * math.sin(0.05))  # phases count


def written_rows(path):
    """Jobs of a bench.csv, values as text"""
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line[:1] != "#"]
    return list(csv.DictReader(lines[: lines.index("")]))


def test_the_yaw_of_a_cylinder_does_not_count_and_that_of_a_box_does():
    for case, counts in ((CYLINDERS[0], False), (BOXES[0], True)):
        right = known(case)
        wrong = right.A.copy()
        wrong[:, 5, 5] += 1e3
        assert (error(case, right._replace(A=wrong)).value > 0) == counts


def test_a_result_that_is_not_a_number_is_refused():
    right = known(CYLINDERS[0])
    with pytest.raises(ValueError, match=r"A11, .* not finite"):
        error(CYLINDERS[0], right._replace(A=np.full_like(right.A, np.nan)))


@pytest.mark.parametrize("graded", [True, False])
@pytest.mark.parametrize("symmetry", ["xy", "y", "rotation"])
@pytest.mark.parametrize("case", [CYLINDERS[0], BOXES[0]], ids=lambda case: case.name)
def test_meshes_for_other_programs_have_the_volume_and_waterplane_of_the_body(case, symmetry, graded):
    if symmetry == "rotation" and case.shape == "box":
        pytest.skip("a box has no rotation")
    made = part(case, 500, graded, symmetry)
    copies = made.get("copies", 2 ** len(symmetry))
    hull, lid = (PanelMesh(made[key]["vertices"], made[key]["faces"]) for key in ("hull", "lid"))
    sizes = list(case.sizes.values())
    area = sizes[0] * sizes[1] if case.shape == "box" else math.pi * sizes[0] ** 2
    assert hull.volume * copies == pytest.approx(area * case.sizes["draft"])
    assert lid.area_vectors[:, 2].sum() * copies == pytest.approx(area, rel=0.02)  # a polygon of fewer sides
    assert -hull.area_vectors[:, 2].sum() * copies == pytest.approx(area)
    assert len(hull) * copies == made["panels"] and 350 < made["panels"] <= 500


class Clock:
    """Stands in for the module `time`: goes on by what is slept, by a tenth of that in processor time"""

    def __init__(self):
        self.now = 1000.0

    def perf_counter(self):
        return self.now

    time = perf_counter

    def process_time(self):
        return self.now / 10

    def sleep(self, seconds):
        self.now += seconds


@pytest.fixture
def slowly(monkeypatch):
    """Clocks of a program whose first pass takes 40 ms a frequency and its others 10, the first frequency 80"""
    clock, made = Clock(), []
    monkeypatch.setattr(repeated, "time", clock)

    def solve(body, omega):
        clock.sleep(0.08 if omega == 1 else 0.04 if body == 1 else 0.01)
        return body, omega

    def run(passes, seconds=60.0, more=0.0):
        asked = {"omega": [1, 2, 3], "passes": passes, "more_s": more, "seconds": seconds, "started": clock.now - 5}
        return repeated.repeated(asked, lambda: made.append(0) or len(made), solve)

    return run


def test_warm_times_are_the_least_of_several_passes_without_the_first_frequency(slowly):
    results, times = slowly(3)
    assert results == [(1, 1), (1, 2), (1, 3)] and times["passes"] == 3
    assert times["warm_ms"] == pytest.approx(10) and times["cpu_ms"] == pytest.approx(1)
    assert times["body_ms"] == pytest.approx(80)
    assert times["first_s"] == pytest.approx(5.08)  # from the start of the process


def test_short_passes_are_made_until_some_time_has_gone(slowly):
    _, times = slowly(1, more=0.7)
    assert times["passes"] == 4  # of 0.26 s and then 0.2, with what threads take to settle


def test_no_new_pass_begins_when_the_time_is_up(slowly):
    _, times = slowly(3, seconds=0.1)
    assert times["passes"] == 1 and times["warm_ms"] == pytest.approx(40) and math.isnan(times["body_ms"])


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="elsewhere only ru_maxrss is known")
def test_peak_memory_is_that_of_the_process_and_not_of_what_started_it():
    held = np.ones(40_000_000)  # 320 MB
    code = "from repeated import peak_memory as p; small = p(); held = bytearray(2 * 10**8); print(small, p())"
    folder = Path(repeated.__file__).parent
    done = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, check=True)
    small, large = map(float, done.stdout.split())
    assert held[0] and small < 100 and large - small == pytest.approx(2e8 / 2**20, rel=0.05)


def test_scripts_of_other_programs_know_nothing_of_this_one():
    for file in Path(repeated.__file__).parent.glob("*.py"):
        text = file.read_text(encoding="utf-8")
        assert not re.search(r"^\s*(import|from) +(bem|meshing|mooring|pipelines|\.)", text, re.MULTILINE)


def test_a_program_that_fails_is_a_row_with_its_reason():
    job = Job("cylinder-30", "capytaine", "direct", 240, 1,
              {"graded": True, "symmetry": "xy", "method": "direct", "quadrature": None})  # fmt: skip
    row = measured(job, {"capytaine": sys.executable}, None)  # which does not have it
    assert "No module named 'capytaine'" in row.note and math.isnan(row.error)


def test_a_bench_holds_every_program_case_and_number_of_threads():
    jobs = plan(PROGRAMS, [1, 2])
    assert {job.program for job in jobs} == set(PROGRAMS)
    for program in ("hakobune", "capytaine"):
        assert {job.case for job in jobs if job.program == program} == set(CASES)
        assert any(job.empty_cache for job in jobs if job.program == program)
    assert {job.threads for job in jobs} == {1, 2}
    assert len({job.title for job in jobs}) == len(jobs)
    assert len(plan(PROGRAMS, [1], quick=True)) < len(jobs) / 5


def test_what_was_measured_is_written_when_a_bench_is_interrupted(tmp_path, monkeypatch):
    row = Row("cylinder-30", "hakobune", "contour", 1e-3, None, 1, "full", 1e-4, "A11", warm_ms=1.0, cpu_ms=1.0)
    monkeypatch.setattr("hakobune.pipelines.validation.bench.run.measured", lambda *asked: row)

    def say(line):
        if line.startswith("1/2"):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        bench([CONTOUR, CONTOUR], {}, tmp_path, say, own_caches=True)
    assert len(written_rows(tmp_path / "bench.csv")) == 1 and (tmp_path / "bench.png").exists()


def test_the_command_measures_what_tolerances_and_panels_promise(tmp_path, capsys, monkeypatch):
    """Panels as `pipelines.solve.panel_counts.panels_for` counts them for a buoy: 250 for one per cent"""
    monkeypatch.setattr("hakobune.pipelines.validation.bench.measure.MORE", 0.0)  # no passes for better times
    monkeypatch.setattr("hakobune.pipelines.validation.bench.run.AGAIN", 0)
    monkeypatch.setattr("hakobune.pipelines.validation.bench.run._to_fill_caches", lambda jobs: ())
    words = ["bench", "--quick", "--only", "cylinder-30", "--output", str(tmp_path / "made")]
    assert main(words) == 0
    assert "other programs are left out" in capsys.readouterr().out
    rows = written_rows(tmp_path / "made" / "bench.csv")
    assert [row["job.settings"] for row in rows] == ["contour", "contour", "panel", "panel", "panel, band"]
    for row in rows:
        fineness = float(row["job.fineness"])
        promised = fineness if row["job.settings"] == "contour" else 0.01 * (250 / fineness) ** ERROR_ORDER
        assert float(row["job.error"]) < promised
        assert 0 < float(row["job.warm [ms]"]) < 1e3 * float(row["job.first [s]"])
        assert float(row["job.memory [MB]"]) > 50


def rows_of(*given):
    """(program, settings, panels, threads, ms, ms of body and first frequency)"""
    return [
        Row("box-20", program, settings, panels, panels, threads, "full", warm_ms=ms, body_ms=first, memory_mb=100.0)
        for program, settings, panels, threads, ms, first in given
    ]


def test_equal_panels_are_compared_within_one_symmetry_and_number_of_threads():
    made = rows_of(
        ("hakobune", "panel, band", 944, 2, 10.0, 410.0),
        ("hakobune", "panel, band", 250, 2, 1.0, 2.0),
        ("hakobune", "panel", 960, 2, 20.0, 60.0),
        ("capytaine", "direct, graded, 2 planes", 960, 2, 400.0, 400.0),
        ("capytaine", "direct, uniform, 2 planes", 960, 2, 300.0, 300.0),
        ("capytaine", "direct, graded, 2 planes", 960, 1, 200.0, 200.0),
        ("capytaine", "direct, graded, rotation", 2500, 2, 100.0, 100.0),
        ("capytaine", "direct, graded, rotation", 980, 2, 50.0, 50.0),
    )
    assert [(row["pair"], row["all_in_ms"], row["times"]) for row in equal_panels(made)] == [
        ("box-20 hakobune panel, band 944, 2 threads, capytaine 2 planes", 20, 30),  # 410 ms and 39 times 10 over 40
        ("box-20 hakobune panel, band 944, 2 threads, capytaine rotation", 20, 5),
        ("box-20 hakobune panel 960, 2 threads, capytaine rotation", 21, 2.5),
    ]


def test_one_thread_is_compared_with_two_of_the_same_settings():
    made = rows_of(
        ("hakobune", "panel, band", 944, 1, 15.0, 1.0),
        ("hakobune", "panel, band", 944, 2, 10.0, 1.0),
        ("hakobune", "panel, band", 3936, 2, 10.0, 1.0),
        ("hakobune", "panel, band", 250, 1, 15.0, 1.0),
        ("hakobune", "panel, band", 250, 2, 10.0, 1.0),
    )
    assert [row["times"] for row in one_thread_and_two(made)] == [1.5]


def test_the_least_time_within_an_error_counts_only_rows_within_it():
    row = Row("box-20", "hakobune", "contour", 1e-3, None, 1, "full")
    rows = [row._replace(error=e, warm_ms=t) for e, t in ((1e-1, 1.0), (1e-3, 5.0), (1e-4, 3.0), (math.nan, 0.1))]
    assert [least_ms(rows, level) for level in (1.0, 1e-2, 1e-4)] == [1.0, 3.0, 3.0]
    assert math.isnan(least_ms(rows, 1e-5))
    (found,) = best(rows)
    assert found["best"] == "box-20 hakobune contour, 1 threads" and found["within_1e-02_ms"] == 3.0


def test_rows_of_another_origin_are_not_replaced(tmp_path, capsys):
    (tmp_path / "bench.csv").write_text("chair,height\n")
    assert main(["bench", "--quick", "--only", "cylinder-30", "--output", str(tmp_path)]) == 2
    assert "bench.csv is not a result of hakobune bench, so it is not replaced" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words, said",
    [
        (["--threads", "0"], "--threads is '0'; allowed"),
        (["--threads", "1,1"], "different whole numbers"),
        (["--only", "box-13"], "'box-13'; allowed: cylinder-15"),
        (["--quick", "--only", "box-12"], "leaves nothing to do"),
        (["--peer", "/not/there/python"], "is not an interpreter of Python that runs"),
        (["--peer", sys.executable], "neither capytaine nor pyhams; `make bench` installs them"),
        (["--output", __file__], "is a file; allowed: a folder"),
    ],
)
def test_a_wrong_word_is_refused_in_one_line(words, said, capsys):
    assert main(["bench", *words]) == 2
    shown = capsys.readouterr().err
    assert said in shown and shown.count("\n") == 1 and shown.startswith("hakobune bench: ")
