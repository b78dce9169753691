"""Rows shared out among threads: each once, a fault comes out, few are not shared."""

import threading

import numpy as np
import pytest

from bem import threads
from bem.threads import WORTH_PAIRS, share_rows


@pytest.fixture
def three_threads(monkeypatch):
    monkeypatch.setattr(threads, "thread_count", lambda: 3)


@pytest.mark.parametrize("rows", [1, 2, 11, 12, 13, 1000])
def test_every_row_is_worked_on_once(rows, three_threads):
    times, lock = np.zeros(rows, int), threading.Lock()

    def work(low, high):
        with lock:
            times[low:high] += 1

    share_rows(work, rows, WORTH_PAIRS)
    assert np.all(times == 1)


def test_few_pairs_stay_in_the_thread_that_asks(three_threads):
    seen = []
    share_rows(lambda low, high: seen.append((low, high, threading.current_thread())), 500, WORTH_PAIRS - 1)
    assert seen == [(0, 500, threading.current_thread())]


def test_a_fault_in_one_share_comes_out(three_threads):
    def work(low, high):
        if low <= 40 < high:
            raise FloatingPointError("row 40")

    with pytest.raises(FloatingPointError, match="row 40"):
        share_rows(work, 100, WORTH_PAIRS)


def test_ctrl_c_leaves_out_the_shares_that_wait(three_threads):
    begun, go_on = [], threading.Event()

    def work(low, high):
        begun.append(low)
        if low == 0:
            raise KeyboardInterrupt
        go_on.wait(0.2)

    with pytest.raises(KeyboardInterrupt):
        share_rows(work, 1200, WORTH_PAIRS)
    assert len(begun) < 12
