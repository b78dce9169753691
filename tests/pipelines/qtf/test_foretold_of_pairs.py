"""What forces of pairs take is told before they begin: counted frequencies, waves and panels, with a known pace."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.second_order.kinds import DIFFERENCE
from hakobune.meshing.shapes import box
from hakobune.pipelines.common import bounds
from hakobune.pipelines.common.progress import duration
from hakobune.pipelines.qtf import foretelling

OMEGA = np.linspace(0.4, 1.2, 9)  # steps of 0.1; differences 0.1 to 0.3 rad/s are no waves of the set, 0.4 is
FINE, ROUGH = (PanelProblem(mesh=box(20, 10, 4, panels=n, symmetry=""), depth=30.0, nodes_per_panel=4)
               for n in (240, 120))  # fmt: skip


def question(highest=0.4, headings=2):
    return SimpleNamespace(omega=OMEGA, headings=np.zeros(headings), highest=highest, kind=DIFFERENCE)


@pytest.fixture
def pace(monkeypatch):
    """Three seconds a frequency and half a gigabyte"""
    monkeypatch.setattr(foretelling, "seconds_alone", lambda prepared, omega: 3.0)
    monkeypatch.setattr(foretelling, "memory_alone", lambda prepared: 5e8)
    return monkeypatch


def test_frequencies_of_waves_and_of_their_differences_are_counted_on_both_meshes(pace, capsys):
    """Nine waves and three differences beside them, on two meshes of 3 s each: 72 s; one mesh takes 36 s"""
    foretelling.foretell((FINE, ROUGH), question())
    said = capsys.readouterr().err
    sizes = f"{FINE.mesh.total} and {ROUGH.mesh.total} panels"
    assert said.startswith(
        f"first-order waves at 12 frequencies on {sizes}, before the pairs of 18 waves: at most about"
    )
    assert said.endswith(f"about {duration(72.0)}\n")
    foretelling.foretell((FINE, None), question())
    assert capsys.readouterr().err == ""


def test_quick_runs_and_other_methods_are_not_told(pace, capsys):
    foretelling.foretell(("by contours", None), question())
    pace.setattr(foretelling, "seconds_alone", lambda prepared, omega: np.nan)
    foretelling.foretell((FINE, ROUGH), question())
    pace.setattr(foretelling, "seconds_alone", lambda prepared, omega: 100.0)
    foretelling.foretell((PanelProblem(mesh=box(20, 10, 4, panels=60), depth=30.0),), question())
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("free, good", [(4e9, True), (2e9, False)])
def test_what_does_not_fit_is_refused_with_the_way_out(pace, capsys, free, good):
    """Of 5000 waves 1.3 kB on each of 240 and 120 panels, and 0.5 GB: 2.8 GB"""
    pace.setattr(bounds, "available_memory", lambda: free)
    asked = question(headings=5000 // 9 + 1)
    if good:
        foretelling.foretell((FINE, ROUGH), asked)
        assert "GB" in capsys.readouterr().err
        return
    with pytest.raises(bounds.TooMuchError, match=r"GB are free; give fewer frequencies \(--omega\)"):
        foretelling.foretell((FINE, ROUGH), asked)
