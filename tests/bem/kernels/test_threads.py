"""Rows distributed over threads: each once, the same bits, exceptions raised, few rows by one thread."""

import threading

import numpy as np
import pytest

from hakobune.bem.green.tables import wave_table
from hakobune.bem.kernels import threads
from hakobune.bem.kernels.threads import PAIRS_WORTH_THREADS, parallel_rows
from hakobune.bem.kochin import far_field_integrals
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.panels.reciprocal_pairs import add_wave_part
from hakobune.bem.panels.wave_influence import wave_blocks
from hakobune.bem.waves import depth_values, wavenumber
from hakobune.meshing.shapes import box


@pytest.fixture
def three_threads(monkeypatch):
    monkeypatch.setattr(threads, "thread_count", lambda: 3)


@pytest.mark.parametrize("rows", [1, 2, 11, 12, 13, 1000])
def test_every_row_is_worked_on_once(rows, three_threads):
    times, lock = np.zeros(rows, int), threading.Lock()

    def work(low, high):
        with lock:
            times[low:high] += 1

    parallel_rows(work, rows, PAIRS_WORTH_THREADS)
    assert np.all(times == 1)


def test_kernels_give_the_same_bits_with_any_number_of_threads(monkeypatch):
    body = prepare(PanelProblem(box(100, 50, 10, panels=300), depth=20.0)).geometry
    nodes, k = body.elements.nodes, float(wavenumber(0.6, 20.0))
    rows, theta = np.arange(len(nodes)), np.linspace(0, 6, 90)
    phi = np.exp(1j * np.outer([1, 2], rows))
    table = wave_table(0.6, 20.0, 9.80665, body.reach, 10.0)

    def results():
        yield from body.rankine_rows(nodes)
        both = np.zeros((2, len(body.classes), len(nodes), len(nodes)))
        add_wave_part(body, body.classes, table, depth_values(k, 20.0), *both)
        yield both
        yield from wave_blocks(body, rows, rows, table, depth_values(k, 20.0))
        yield from far_field_integrals(
            theta, k, nodes, body.elements.weights, body.elements.normals, depth_values(k, 20.0)(nodes[:, 2]),
            body.images, body.all_signs[0], phi, 1j * phi,
        )  # fmt: skip

    assert len(body.images) * len(nodes) * min(len(nodes), len(theta)) > PAIRS_WORTH_THREADS
    found = []
    for count in (1, 3):
        monkeypatch.setattr(threads, "thread_count", lambda count=count: count)
        found.append([a.tobytes() for a in results()])
    assert found[0] == found[1]


def test_few_pairs_stay_in_the_thread_that_asks(three_threads):
    seen = []
    parallel_rows(lambda low, high: seen.append((low, high, threading.current_thread())), 500, PAIRS_WORTH_THREADS - 1)
    assert seen == [(0, 500, threading.current_thread())]


def test_a_fault_in_one_share_comes_out(three_threads):
    def work(low, high):
        if low <= 40 < high:
            raise FloatingPointError("row 40")

    with pytest.raises(FloatingPointError, match="row 40"):
        parallel_rows(work, 100, PAIRS_WORTH_THREADS)


def test_ctrl_c_leaves_out_the_shares_that_wait(three_threads):
    begun, go_on, before = [], threading.Event(), threading.active_count()

    def work(low, high):
        begun.append(low)
        if threading.current_thread() is threading.main_thread():
            raise KeyboardInterrupt
        go_on.wait(1.0)

    with pytest.raises(KeyboardInterrupt):
        parallel_rows(work, 1200, PAIRS_WORTH_THREADS)
    assert len(begun) <= 3
    assert threading.active_count() == before


@pytest.mark.parametrize("rows, ranges", [(100, 12), (11, 11), (13, 12)])
def test_every_thread_has_four_ranges_of_rows_or_as_many_as_there_are(rows, ranges, three_threads):
    seen, lock = [], threading.Lock()

    def work(low, high):
        with lock:
            seen.append((low, high))

    parallel_rows(work, rows, PAIRS_WORTH_THREADS)
    ends = np.linspace(0, rows, ranges + 1).astype(int)
    assert sorted(seen) == list(zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True))
