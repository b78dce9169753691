"""A person who waits for the compiler is told so; a file or a pipe is not."""

import io
import sys

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
