"""Large panel problems: which share their work, what is said of them first, what is refused."""

import subprocess
import sys
from dataclasses import replace
from io import StringIO
from types import SimpleNamespace

import numpy as np
import pytest
from rich.console import Console

from hakobune.bem.kernels.progress import FACTORS, FINER, MATRICES, WAVES, progress_callback
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.panels.band import cost
from hakobune.bem.panels.band.cost import Cost
from hakobune.bem.panels.influence import Geometry
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy
from hakobune.pipelines.common import bounds, progress
from hakobune.pipelines.common.progress import Preparing, Progress
from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.solve import large
from hakobune.pipelines.solve.large import Telling, announced, shared_band


def scene(**waves):
    return make_scene(
        {
            "water": {"depth": 20.0},
            "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0}],
            "waves": waves,
            "method": "panel",
        }
    )


def test_many_frequencies_on_many_panels_share_their_work():
    many, few = {"from": 0.2, "to": 1.0, "count": 40}, {"from": 0.2, "to": 1.0, "count": 30}
    fine, coarse = box(100, 50, 10, panels=600), box(100, 50, 10, panels=104)
    assert shared_band(scene(omegas=many), fine) == pytest.approx((0.2, 1.0))
    assert shared_band(scene(omegas=few), fine) is None
    assert shared_band(scene(omegas=many), coarse) is None


def test_bodies_without_mirror_planes_share_their_work_in_four_times_as_many_frequencies():
    """One system of equations a frequency in place of four; the preparation takes as long"""
    quarter = box(100, 50, 10, panels=2400)
    whole = replace(quarter, symmetry="")
    few, more = ({"from": 0.2, "to": 1.0, "count": count} for count in (7, 20))
    assert shared_band(scene(omegas=few), quarter) == pytest.approx((0.2, 1.0))
    assert shared_band(scene(omegas=few), whole) is None
    assert shared_band(scene(omegas=more), whole) == pytest.approx((0.2, 1.0))


def test_axisymmetric_bodies_share_their_work_in_hundreds_of_frequencies_only():
    many, more = {"from": 0.2, "to": 1.0, "count": 100}, {"from": 0.2, "to": 1.0, "count": 200}
    fine = buoy(10, 8, panels=1000)
    assert shared_band(scene(omegas=many), fine, lid(fine)) is None
    assert shared_band(scene(omegas=more), fine, lid(fine)) == pytest.approx((0.2, 1.0))
    skew = replace(fine, points=fine.points * (1.001, 1, 1))
    assert shared_band(scene(omegas=many), skew) == pytest.approx((0.2, 1.0))


def test_frequencies_of_very_many_panels_share_their_work_only_where_they_are_many():
    """Compressed ones take less; and factors of very many nodes do not fit"""
    fine, finest = box(100, 50, 10, panels=3000), box(100, 50, 10, panels=11_000)
    few, many = ({"from": 0.2, "to": 1.0, "count": count} for count in (6, 8))
    assert shared_band(scene(omegas=many), fine) == pytest.approx((0.2, 1.0))
    assert shared_band(scene(omegas=few), fine) is None
    assert shared_band(scene(omegas=many), finest) is None


def test_what_does_not_fit_is_refused_in_one_line(monkeypatch):
    mesh = box(100, 50, 10, panels=120)
    problem = PanelProblem(mesh, lid(mesh), depth=20.0, band=(0.5, 0.5))
    monkeypatch.setattr(large, "NODES_WORTH_TELLING", 100)
    monkeypatch.setattr(cost, "cost", lambda *_: Cost(5e9, {WAVES: (60.0, 1.0)}))
    monkeypatch.setattr(bounds, "available_memory", lambda: 8e9)
    announced(problem, 0, None)
    with pytest.raises(
        SceneError, match=r"need about 10 GB, and 8.0 GB are free; give fewer panels .* fewer processes"
    ):
        announced(problem, 0, None, processes=2)
    monkeypatch.setattr(bounds, "available_memory", lambda: 4e9)
    with pytest.raises(SceneError, match=r"^[0-9]+ panels need about 5 GB, and 4.0 GB are free; give fewer panels"):
        announced(problem, 0, None)


@pytest.mark.parametrize("options", [{"depth": 20.0}, {"depth": 20.0, "zero_draft": True}])
def test_what_does_not_fit_alone_is_refused_before_a_matrix_is_made(options, monkeypatch):
    monkeypatch.setattr(bounds, "available_memory", lambda: 0.5e9)
    mesh = box(100, 50, 1, panels=8000)
    with pytest.raises(
        SceneError, match=r"^[0-9]+ panels need about [0-9.]+ GB, and 0.5 GB are free; give fewer panels"
    ):
        announced(PanelProblem(mesh, **options), 0, None)


def test_a_buoy_of_hundreds_of_waves_is_told_with_its_time():
    said = []
    console = SimpleNamespace(print=lambda text, **_: said.append(text))
    buoy_of_many = ShapeProblem(method="contour", shape="buoy", sizes=(1207.0, 0.026), depth=1.0269)
    announced(buoy_of_many, 0, console, omegas=[2.577])
    assert len(said) == 1 and said[0].startswith("buoy of 1207 m: its contour takes about 1 min")
    announced(buoy_of_many, 0, console, omegas=[0.5])
    assert len(said) == 1


def test_panels_for_the_tolerance_are_told_with_their_time(monkeypatch):
    said, mesh = [], box(100, 50, 10, panels=500)
    console = SimpleNamespace(print=lambda text, **_: said.append(text))
    finer = PanelProblem(mesh, depth=20.0).prepared()
    monkeypatch.setattr(cost, "seconds_alone", lambda *_: 42.0)
    monkeypatch.setattr(large, "NODES_WORTH_ASKING", 100)
    Telling(console)(FINER, (finer, 0.5))
    assert said == [f"ω 0.5 rad/s: {mesh.total} panels for the tolerance need about 42 s"]
    monkeypatch.setattr(cost, "seconds_alone", lambda *_: 2.0)
    Telling(console)(FINER, (finer, 0.5))
    assert len(said) == 1


ALONE = """
import sys
from hakobune.bem import DOFS
from hakobune.bem.panels.band.cost import memory_alone
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.meshing.shapes import box, buoy
from hakobune.pipelines.validation.bench.peers.repeated import peak_memory
name, panels, *sizes = sys.argv[1:]
hull = {"box": box, "buoy": buoy}[name](*map(int, sizes), panels=int(panels))
body = PanelProblem(hull, depth=20.0).prepared()
body.run(0.6, [0.5], {"added_mass", "excitation_force", "drift_force_fixed"}, None, DOFS).result()
print(memory_alone(body) / 1e6, peak_memory() * 1.048576)
"""


@pytest.mark.parametrize("shape, panels", [("box 100 50 10", ("400", "1600")), ("buoy 20 10", ("400", "8000"))])
def test_memory_of_a_frequency_alone_is_what_was_estimated(shape, panels):
    """What grows with the panels; of two processes, since a peak does not come down"""
    name, *sizes = shape.split()
    commands = [[sys.executable, "-c", ALONE, name, n, *sizes] for n in panels]
    told = [subprocess.run(command, capture_output=True, check=True) for command in commands]
    few, many = (np.array(one.stdout.split(), float) for one in told)
    estimated, taken = many - few
    assert 0.7 * taken < estimated < 1.4 * taken


def test_the_estimate_of_memory_counts_the_matrices_of_all_classes():
    few, many = (Geometry(box(100, 50, 10, panels=n), None, 20.0) for n in (240, 944))
    matrices = [8.0 * len(g.classes) * g.hull**2 for g in (few, many)]
    needed = [cost.cost(g, (0.4, 0.6), 9.81) for g in (few, many)]
    # twice the nodes to a class: four times the matrices, and what goes with the first power
    assert all(n.memory > m for n, m in zip(needed, matrices, strict=True))
    assert needed[1].memory - needed[0].memory >= matrices[1] - matrices[0]
    assert 0 < needed[0].seconds < needed[1].seconds < np.inf


def test_what_the_preparation_tells_adds_up_to_what_was_estimated():
    mesh, band = box(100, 50, 10, panels=240), (0.4, 1.2)
    body = PanelProblem(mesh, lid(mesh), depth=20.0, band=band).prepared()
    stages, told = cost.cost(body.geometry, band, 9.81).stages, []
    with progress_callback(lambda stage, count: told.append((stage, count))):
        assert len(body.band_equations) == 2  # without and with the lid
    sums = {stage: sum(count for one, count in told if one == stage) for stage in stages}
    assert sums[MATRICES] == stages[MATRICES][0] == len(body.geometry.elements.nodes)
    assert sums[FACTORS] == stages[FACTORS][0] == 4
    assert 0 < sums[WAVES] < stages[WAVES][0]  # a generous guess
    assert [stage for stage, _ in told] == sorted((stage for stage, _ in told), key=list(stages).index)


def test_the_share_that_is_prepared_grows_to_the_whole(monkeypatch):
    """40 s by estimate, and twice that by the clock: at half of it 44 s and 4 s of trust are gone for 20 and 4"""
    monkeypatch.setattr(Preparing, "EVERY", 0.0)
    clock = iter([0.0, 1.0, 2.0, 30.0, 44.0, 50.0, 60.0, 70.0, 80.0])
    monkeypatch.setattr(progress.time, "perf_counter", lambda: next(clock))
    console = Console(record=True, quiet=False, file=StringIO(), width=100)
    preparing = Preparing(console, Cost(0.0, {WAVES: (10, 1.0), MATRICES: (4, 5.0), FACTORS: (2, 5.0)}))
    for stage in (WAVES, WAVES, MATRICES, MATRICES, MATRICES, MATRICES, FACTORS, FACTORS):
        preparing(stage, 1)
    lines = console.export_text().splitlines()
    assert [line.split()[1] for line in lines] == ["2", "5", "38", "50", "62", "75", "88"]  # 40 s in all; not of 100 %
    assert all(line.endswith(" left") for line in lines) and lines[3].split()[3:] == ["40", "s", "left"]


def test_time_left_is_that_of_frequencies_whoever_prepared_the_body(monkeypatch):
    """Four processes that each prepared for 90 s, all at the same time"""
    clock = iter([0.0, 100.0, 101.0, 102.0, 103.0])
    monkeypatch.setattr(progress.time, "perf_counter", lambda: next(clock))
    console = Console(record=True, file=StringIO(), width=200)
    lines = Progress(console, 30)
    for _ in range(4):
        lines.step(0.5, {"wall_time": {"reduction": 90.0, "solve": 1.0}}, "")
    left = [" ".join(line.split(" left")[0].split()[-4:]) for line in console.export_text().splitlines()]
    assert left == ["4 min 50 s", "2 min 34 s", "1 min 48 s", "1 min 24 s"]


def test_free_memory_is_known_and_no_more_than_a_container_leaves(tmp_path):
    assert 1e6 < bounds.available_memory() < np.inf
    assert bounds._left_to_container(tmp_path) == np.inf
    files = {"memory.max": "8000", "memory.current": "5000", "memory.stat": "anon 4000\ninactive_file 700\n"}
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    assert bounds._left_to_container(tmp_path) == 3700
    (tmp_path / "memory.max").write_text("max")
    assert bounds._left_to_container(tmp_path) == np.inf


def test_a_contour_far_more_slender_than_there_is_memory_or_time_for_is_refused(monkeypatch):
    slender = ShapeProblem(method="contour", shape="box", sizes=(1e5, 1.0, 1.0), depth=20.0)
    with pytest.raises(SceneError, match=r"box of 1e\+09 m by 1 m: its contour needs about .* GB.*--method panel"):
        announced(replace(slender, sizes=(1e9, 1.0, 1.0)), 0, None, omegas=[0.1])
    monkeypatch.setattr(bounds, "available_memory", lambda: 1e9)
    with pytest.raises(SceneError, match=r"needs about [0-9.]+ GB, and 1.0 GB are free; give a less slender body"):
        announced(slender, 0, None, omegas=[0.1])
    assert announced(replace(slender, sizes=(100.0, 50.0, 10.0)), 0, None, omegas=[0.1]) is None


@pytest.mark.parametrize("symmetry, panels, least", [("xy", 144, 37), ("xy", 236, 18), ("x", 370, 18), ("", 784, 12)])
def test_many_frequencies_share_their_work_where_it_pays(symmetry, panels, least, monkeypatch):
    """Frequencies times classes times nodes^1.5, four nodes a panel, above two million"""
    nodes, classes = 4 * panels, 2 ** len(symmetry)
    assert least == int(2e6 / (classes * nodes**1.5)) + 1
    alone = SimpleNamespace(axisymmetric_geometry=SimpleNamespace(sectors=0))
    monkeypatch.setattr(large, "PanelProblem", lambda *given, **more: SimpleNamespace(prepared=lambda: alone))

    class Mesh(list):
        pass

    mesh = Mesh([0] * panels)
    mesh.symmetry = symmetry
    for count, shared in ((least - 1, None), (least, (0.2, 1.5))):
        scene = SimpleNamespace(omegas=lambda count=count: np.linspace(0.2, 1.5, count), wall=None,
                                waves=SimpleNamespace(band=None), water=SimpleNamespace(depth=20.0))  # fmt: skip
        assert large.shared_band(scene, mesh) == shared
