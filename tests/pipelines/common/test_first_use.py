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


def test_the_first_kernel_that_is_compiled_is_told_of_once(monkeypatch):
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    teller = tell_first_use()
    try:
        for step in (1.0, 2.0):
            assert numba.njit(lambda x, step=step: x + step)(1.0) == 1.0 + step
    finally:
        event.unregister("numba:compile", teller)
    assert sys.stderr.getvalue().count("compiling kernels") == 1


def test_what_is_asked_for_before_the_first_kernel_is_called_once(monkeypatch):
    monkeypatch.setattr(jit, "_before_first", [])
    called = []
    jit.before_first_kernel(lambda: called.append("called"))
    assert [jit._dispatcher(lambda x, step=step: x + step, False)(1.0) for step in (1.0, 2.0)] == [2.0, 3.0]
    assert called == ["called"]


@pytest.mark.parametrize(
    ("words", "terminal", "told"),
    [("simulate study.toml", True, True), ("series lines", True, True), ("qtf box.h5", True, True)]
    + [("simulate study.toml", False, False), ("simulate --help", True, False), ("keys", True, False)],
)
def test_every_command_that_computes_tells_it_at_a_terminal_and_only_there(words, terminal, told, monkeypatch):
    class Screen(io.StringIO):
        def isatty(self):
            return terminal

    monkeypatch.setattr(jit, "_before_first", [])
    monkeypatch.setattr(sys, "argv", ["hakobune", *words.split()])
    monkeypatch.setattr(sys, "stderr", Screen())
    for name in ("_put_off_compiling", "_spare_numpy", "_leave_cycles"):  # this process goes on
        monkeypatch.setattr(start, name, lambda: None)
    monkeypatch.setattr(cli, "main", lambda: 0)
    monkeypatch.setattr(signal, "signal", lambda *given: None)
    assert start.main() == 0
    assert jit._before_first == [tell_first_use] * told
