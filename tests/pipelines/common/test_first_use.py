"""A person who waits for the compiler is told so; a file or a pipe is not."""

import io
import signal
import sys

import numba
import pytest
from numba.core import event

from hakobune.bem.kernels import jit
from hakobune.pipelines import cli, start
from hakobune.pipelines.common.first_use import tell_first_use
from hakobune.pipelines.printing import timing


def test_what_is_asked_for_before_the_first_kernel_is_called_once(monkeypatch):
    monkeypatch.setattr(jit, "_before_first", [])
    called = []
    jit.before_first_kernel(lambda: called.append("called"))
    assert [jit.kernel()(lambda x, step=step: x + step)(1.0) for step in (1.0, 2.0)] == [2.0, 3.0]
    assert called == ["called"]


@pytest.mark.parametrize("terminal", [True, False])
def test_a_kernel_that_is_compiled_is_told_at_a_terminal_only_and_timed_in_both(terminal, monkeypatch):
    class Screen(io.StringIO):
        def isatty(self):
            return terminal

    monkeypatch.setattr(sys, "stderr", Screen())
    timing.begin()
    teller = tell_first_use()
    try:
        for step in (1.0, 2.0):
            assert numba.njit(lambda x, step=step: x + step)(1.0) == 1.0 + step
    finally:
        event.unregister("numba:compile", teller)
        lines = timing.told()
    assert sys.stderr.getvalue().count("compiling kernels") == terminal
    assert float(next(line for line in lines if line.startswith(timing.KERNELS)).split()[2]) > 0.01


def test_every_command_tells_it(monkeypatch):
    monkeypatch.setattr(jit, "_before_first", [])
    monkeypatch.setattr(sys, "argv", ["hakobune", "simulate", "study.toml"])
    monkeypatch.setattr(cli, "main", lambda: 0)
    monkeypatch.setattr(signal, "signal", lambda *given: None)
    assert start.main() == 0
    assert jit._before_first == [tell_first_use]
