"""A person who waits for the compiler is told so; a file or a pipe is not."""

import io
import sys
from importlib import import_module

import numba
import pytest
from numba.core import event

from pipelines.common.first_use import tell_first_use


@pytest.mark.parametrize("terminal", [True, False])
def test_the_first_kernel_that_is_compiled_is_told_of_once_and_only_at_a_terminal(monkeypatch, terminal):
    class Screen(io.StringIO):
        def isatty(self):
            return terminal

    monkeypatch.setattr(sys, "stderr", Screen())
    teller = tell_first_use()
    for step in (1.0, 2.0):
        assert numba.njit(lambda x, step=step: x + step)(1.0) == 1.0 + step
    assert sys.stderr.getvalue().count("compiling kernels") == terminal
    if teller is not None:
        event.unregister("numba:compile", teller)


@pytest.mark.parametrize(
    ("words", "first_step"),
    [
        (["simulate", "study.toml", "--database", "box.h5", "--output", "run.h5"], ("simulate.command", "fill")),
        (["design", "project.toml", "--output", "report"], ("design.command", "made")),
    ],
    ids=["simulate", "design"],
)
def test_commands_whose_kernels_take_long_to_compile_tell_it_before_their_first_step(
    words, first_step, monkeypatch, tmp_path
):
    from pipelines.cli import main

    module, name = first_step
    command, told = import_module(f"pipelines.{module}"), []
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("pipelines.common.first_use.tell_first_use", lambda: told.append("told"))
    monkeypatch.setattr(command, "tell_first_use", lambda: told.append("told"), raising=False)
    monkeypatch.setattr("pipelines.design.project.read_project", lambda path: None)

    def step(*given, **more):
        told.append(name)
        raise KeyboardInterrupt

    monkeypatch.setattr(command, name, step)
    assert main(words) == 130
    assert told == ["told", name]
