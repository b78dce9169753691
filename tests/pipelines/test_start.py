"""Where the process begins."""

import signal
import subprocess
import sys

import pytest

from hakobune.pipelines import cli, start


def test_scipy_loads_no_package_of_numpy_that_nothing_uses_and_each_is_there_when_it_is_used():
    lines = (
        "import sys; from hakobune.pipelines.start import _spare_numpy; _spare_numpy()",
        "import scipy.special, scipy.linalg, numpy",
        "assert not {'numpy.f2py', 'numpy.testing'} & set(sys.modules)",
        "numpy.testing.assert_equal(1, 1)",
        "assert 'numpy.testing' in sys.modules",
        "import numpy.testing, numpy.f2py; assert numpy.f2py.__file__ and numpy.testing.__file__",
    )
    subprocess.run([sys.executable, "-c", "\n".join(lines)], check=True)


@pytest.mark.parametrize(("command", "put_off"), [("design", False), ("moor", True)])
def test_a_design_has_the_same_digits_whatever_was_compiled_before(command, put_off, monkeypatch):
    """No kernel of it is evaluated uncompiled, whose sums end otherwise"""
    asked = []
    monkeypatch.setattr(sys, "argv", ["hakobune", command, "x.toml"])
    monkeypatch.setattr(start, "_put_off_compiling", lambda: asked.append(command))
    monkeypatch.setattr(start, "_spare_numpy", lambda: None)
    monkeypatch.setattr(start, "_leave_cycles", lambda: None)  # this process goes on
    monkeypatch.setattr(cli, "main", lambda: 0)
    monkeypatch.setattr(signal, "signal", lambda *given: None)
    assert start.main() == 0 and bool(asked) is put_off
