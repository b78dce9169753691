"""Memory and time that are told before work begins, by their formulas."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.contour.cost import cost as cost_of_contour
from hakobune.bem.contour.one_frequency import degrees
from hakobune.bem.contour.solver import prepare_box, prepare_cylinder
from hakobune.bem.kernels.progress import FACTORS, MATRICES, WAVES
from hakobune.bem.panels.band import cost


def prepared(nodes, classes=4, compressed=False, sectors=None, zero_draft=False, images=4):
    geometry = SimpleNamespace(elements=SimpleNamespace(nodes=range(nodes)), classes=range(classes), sectors=sectors,
                               images=range(images), hull=nodes)  # fmt: skip
    problem = SimpleNamespace(zero_draft=zero_draft, gravity=9.81)
    return SimpleNamespace(geometry=geometry, axisymmetric_geometry=geometry, problem=problem, compressed=compressed)


def test_memory_of_a_frequency_alone_is_that_of_its_matrices_and_of_the_program():
    """54 bytes a pair and class; 100 a row of a sector; compressed 2 kB a node and doubling; and 0.4 GB"""
    few, program = 3000, 4e8
    assert cost.memory_alone(prepared(few)) == pytest.approx(54 * 4 * 9e6 + program)
    ring = SimpleNamespace(first=range(50))
    assert cost.memory_alone(prepared(few, sectors=ring)) == pytest.approx(100 * 4 * 3000 * 50 + program)
    assert cost.memory_alone(prepared(few, sectors=ring, zero_draft=True)) == pytest.approx(54 * 4 * 9e6 + program)
    many = prepared(80_000, compressed=True)
    assert cost.memory_alone(many) == pytest.approx(2.0e3 * 80_000 * np.log2(80_000) + program)
    assert cost.memory_alone(prepared(few, compressed=True, sectors=ring)) == pytest.approx(6e7 + program)
    for nodes, kept in ((21_999, 1.44e4), (22_000, 0.0)):  # Rankine parts of so many are kept
        some = cost.memory_alone(prepared(nodes, compressed=True))
        assert some == pytest.approx(2.0e3 * nodes * np.log2(nodes) + kept * nodes + program)


def test_time_of_a_frequency_alone_is_that_of_its_rows_and_factors(monkeypatch):
    """Waves of half of the pairs; factors of n³ as measured with 1500; 370 evaluations a doubling of compressed ones"""
    monkeypatch.setattr(cost, "_seconds_of_waves", lambda *_: 0.02)
    monkeypatch.setattr(cost, "_seconds_of_rows", lambda *_: 0.003)
    monkeypatch.setattr(cost, "_seconds_of_factor", lambda *_: 0.05)
    assert cost.seconds_alone(prepared(3000), 0.5) == pytest.approx(3000 * 0.013 + 4 * 0.05 * 8)
    assert cost.seconds_alone(prepared(65536, compressed=True), 0.5) == pytest.approx(370 * 16 * 0.023 / 4)
    for other in (prepared(3000, sectors=SimpleNamespace(first=range(9))), prepared(3000, zero_draft=True)):
        assert np.isnan(cost.seconds_alone(other, 0.5))


def test_a_band_takes_its_samples_its_rows_and_the_factors_of_all_classes(monkeypatch):
    """600 columns of waves and twice those of the lid; for each wavenumber a share of the samples, and 600"""
    geometry = SimpleNamespace(hull=2000, classes=range(2), elements=SimpleNamespace(nodes=range(2300)))
    snapshots = SimpleNamespace(wavenumbers=range(7), samples=lambda: SimpleNamespace(nodes=range(900)))
    monkeypatch.setattr(cost, "split_by_lid", lambda *_: [(1, 2), (3, 4)])
    monkeypatch.setattr(cost, "Snapshots", lambda *_: snapshots)
    monkeypatch.setattr(cost, "_seconds_of_waves", lambda g, w, _: 0.02 * w)
    monkeypatch.setattr(cost, "_seconds_of_rows", lambda *_: 0.003)
    monkeypatch.setattr(cost, "_seconds_of_factor", lambda *_: 0.05)
    found = cost.cost(geometry, (0.5, 2.0), 9.81)
    columns = 600 + 600
    assert found.memory == pytest.approx(8 * 2 * (4e6 + 2 * 2000 * columns) + 8 * 2000 * columns + 4e8)
    rows = 2 * 7 * (900 / cost.STRIDE + 600)
    factor = 0.05 * ((2000 / 1500) ** 3 + 3 * columns * 4e6 / 1500**3)
    expected = {WAVES: (rows, 0.04), MATRICES: (2300, 0.003), FACTORS: (2, factor)}
    for stage, pair in expected.items():
        assert found.stages[stage] == pytest.approx(pair)
    assert found.seconds == pytest.approx(rows * 0.04 + 2300 * 0.003 + 2 * factor)


def test_the_contour_method_takes_its_table_once_and_the_cube_of_its_degrees_a_frequency():
    """4e-9 c p³ s and 65 c p² bytes, 2e-8 p'³ s and 1000 p'² bytes, of body and finer one; of a circle 8e-8 (ka)³"""
    body, k = prepare_box(60.0, 20.0, 5.0, 10.0, 1e-3), 1.3
    expected = np.zeros(3)
    for one in (body, body.finer):
        waves, table = degrees(one, k)
        c, p, q = len(one.nodes(table).kappa), sum(table), sum(waves)
        expected += [4e-9 * c * p**3, 2e-8 * q**3, 65 * c * p**2 + 1000 * q**2]
    assert cost_of_contour(body, k) == pytest.approx(tuple(expected))
    assert cost_of_contour(prepare_cylinder(30.0, 5.0, 10.0), 4.0) == pytest.approx((0.0, 8e-8 * 120**3, 0.0))


def test_times_are_the_shortest_of_three_after_one_that_compiles(monkeypatch):
    clock = iter([0.0, 9.0, 10.0, 10.5, 11.0, 11.2, 12.0, 12.4])
    done = []
    monkeypatch.setattr(cost.time, "perf_counter", lambda: next(clock))
    assert cost._seconds(lambda: done.append(1)) == pytest.approx(0.2) and len(done) == 4


@pytest.mark.parametrize("nodes, images, rows", [(100, 4, 50), (10, 1, 10), (50_000, 4, 16), (2000, 1, 16)])
def test_so_many_rows_are_timed_that_threads_share_them(nodes, images, rows):
    """Sixteen, or as many as make 20 000 pairs; spread over all, and never more than there are"""
    geometry = SimpleNamespace(elements=SimpleNamespace(nodes=range(nodes)), images=range(images))
    found = cost._timed_rows(geometry)
    step = max(nodes // max(16, int(np.ceil(20_000 / (nodes * images)))), 1)
    assert found.tolist() == list(range(0, nodes, step)) and len(found) >= rows


def test_a_row_takes_its_share_of_the_rows_that_are_timed(monkeypatch):
    """Waves at a table's wavenumber, Rankine parts at the same nodes; factors of 1500 unknowns of either precision"""
    nodes = np.arange(24.0).reshape(8, 3)
    asked = []
    geometry = SimpleNamespace(elements=SimpleNamespace(nodes=nodes), images=range(4), depth=9.0, reach=40.0, draft=3.0,
                               rankine_rows=lambda points: asked.append(points.tolist()))  # fmt: skip
    monkeypatch.setattr(cost, "_seconds", lambda work: work() or 6.0)
    monkeypatch.setattr(cost, "_timed_rows", lambda g: np.array([1, 3, 5]))
    monkeypatch.setattr(cost, "wave_table", lambda *them: SimpleNamespace(k=0.3, them=them))
    monkeypatch.setattr(cost, "wave_blocks", lambda g, some, every, table, Z: asked.append(
        (some.tolist(), len(every), table.them, Z(np.array([-9.0]))[0, 0])))  # fmt: skip
    assert cost._seconds_of_rows(geometry) == 2.0 and asked == [nodes[[1, 3, 5]].tolist()]
    assert cost._seconds_of_waves(geometry, 0.8, 9.81) == 2.0
    some, count, table, bed = asked[1]
    assert (some, count, table) == ([1, 3, 5], 8, (0.8, 9.0, 9.81, 40.0, 3.0))
    assert bed == pytest.approx(1 / np.cosh(2.7))
    from scipy import linalg

    seen = []
    monkeypatch.setattr(linalg, "lu_factor", lambda A, check_finite: seen.append((A.shape, A.dtype)))
    assert cost._seconds_of_factor() == cost._seconds_of_factor(np.float32) == 6.0
    assert seen == [((1500, 1500), np.float64), ((1500, 1500), np.float32)]
