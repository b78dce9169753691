"""Pictures of forces of wave pairs whose values are set by hand: which motion, which heading, which unit."""

from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.axes import Axes

from hakobune.bem import DOFS
from hakobune.bem.second_order.kinds import DIFFERENCE, SUM
from hakobune.bem.second_order.quadratic_forces import QuadraticForces
from hakobune.bem.second_order.stored import Held, StoredForces
from hakobune.pipelines.qtf.plot import draw

OMEGA = np.array([0.4, 0.5, 0.6, 0.7])
DEEP, SHALLOW = SimpleNamespace(water_depth=np.inf), SimpleNamespace(water_depth=25.0)
TWO = tuple(f"{body}__{dof}" for body in ("barge", "buoy") for dof in DOFS)


def stored(kind, largest, count=6, floats=True):
    """Pairs of two headings: 100 N/m² everywhere, {(heading, mode): size} in equal headings"""
    frequency = np.array([0.0, 0.1, 0.2]) if kind is DIFFERENCE else np.array([0.8, 0.9, 1.0, 1.1])
    squares = np.full((len(frequency), 4, 2, 2, count), 100.0 + 0j)
    for (h, mode), size in largest.items():
        squares[:, :, h, h, mode] = size
    squares[:, :, 0, 1] = squares[:, :, 1, 0] = 1e12  # pairs of unequal headings are not shown
    nothing = np.zeros_like(squares)
    headings = np.radians([150.0, 180.0])
    forces = QuadraticForces(OMEGA, frequency, headings, squares, nothing, 0.5 * squares, None, kind=kind)
    words = {} if count == 6 else {"names": TWO}
    return StoredForces(forces, Held(floats), **words)


def test_the_picture_of_differences_is_of_the_heading_with_the_largest_surge_or_sway(pictures, tmp_path):
    """Of squares of 4 kN/m² with half of it for the body: 6; heave and yaw are larger and are no slow drift"""
    found = draw(stored(DIFFERENCE, {(0, 0): 3e3, (1, 1): 4e3, (0, 2): 9e3, (1, 5): 9e3}), DEEP, tmp_path / "p.png")
    assert pictures == [found] and len(found.axes) == 5  # two of them with a scale of colours
    level, rule, parts = found.axes[:3]
    assert found.get_suptitle() == "slow force of pairs of waves, sway, 180°, floating, deep water"
    assert level.get_title() == "|T| of sway, kN/m²" and rule.get_title().startswith("log10 of Newman's approximation")
    assert level.lines[0].get_xydata().tolist() == [[0.4, 0.4], [0.7, 0.7]]  # equal frequencies
    drawn = {line.get_label(): line.get_ydata() for line in parts.lines}
    assert drawn["squares + bound wave"] == pytest.approx([4.0] * 3) and drawn["+ body"] == pytest.approx([6.0] * 3)
    assert drawn["Newman"] == pytest.approx([4.0] * 3) and parts.get_ylim()[0] == 0
    assert parts.lines[0].get_xdata().tolist() == [0.0, 0.1, 0.2]


def test_the_picture_of_sums_is_of_the_largest_force_and_the_largest_moment(pictures, tmp_path):
    """Heave of 9 + 4.5 kN/m², pitch of 2 + 1 MN m/m², each in its unit and under its name"""
    found = draw(stored(SUM, {(1, 2): 9e3, (0, 4): 2e6}, floats=False), SHALLOW, tmp_path / "p.png")
    named = [one.get_title() for one in found.axes if one.get_title()]
    assert named == ["|T| of heave, 180°, kN/m²", "heave, 180°: root mean square over pairs, kN/m²",
                     "|T| of pitch, 150°, MN m/m²", "pitch, 150°: root mean square over pairs, MN m/m²"]  # fmt: skip
    assert found.get_suptitle().endswith("at the sum of their frequencies, fixed, water 25 m")
    for axes, size in ((found.axes[1], 9.0), (found.axes[3], 2.0)):
        drawn = {line.get_label(): line.get_ydata() for line in axes.lines}
        assert drawn["squares"] == pytest.approx([size] * 4) and drawn["+ body"] == pytest.approx([1.5 * size] * 4)
        assert axes.lines[0].get_xdata().tolist() == [0.8, 0.9, 1.0, 1.1] and axes.get_ylim()[0] == 0


def test_the_picture_of_sums_of_two_bodies_names_body_and_motion(pictures, tmp_path):
    found = draw(stored(SUM, {(0, 8): 9e3, (1, 10): 2e6}, count=12), DEEP, tmp_path / "p.png")
    named = [one.get_title() for one in found.axes if one.get_title()]
    assert named[0] == "|T| of buoy heave, 150°, kN/m²" and named[2] == "|T| of buoy pitch, 180°, MN m/m²"


@pytest.mark.parametrize(("kind", "mode", "unit"), [(DIFFERENCE, 1, 1e3), (SUM, 2, 1e3)])
def test_levels_lie_at_both_frequencies_of_each_pair_that_there_is(pictures, tmp_path, monkeypatch, kind, mode, unit):
    """ω₁ = ω₂ + Ω of a difference, Ω − ω₂ of a sum; pairs that are not stored are left out"""
    seen = []
    contour = Axes.tricontourf

    def kept(axes, one, two, value, **more):
        seen.append((one, two, value))
        return contour(axes, one, two, value, **more)

    monkeypatch.setattr(Axes, "tricontourf", kept)
    made = stored(kind, {(1, mode): 4e3, (1, 4): 2e3})
    made.forces.squares[1, 3] = np.nan
    draw(made, DEEP, tmp_path / "p.png")
    one, two, value = seen[0]
    frequency = made.forces.frequency
    pairs = [(w, W + w if kind is DIFFERENCE else W - w) for i, W in enumerate(frequency) for j, w in enumerate(OMEGA)
             if (i, j) != (1, 3)]  # fmt: skip
    assert np.stack([one, two], axis=1) == pytest.approx(np.array(pairs))
    assert value == pytest.approx(np.full(len(pairs), 1.5 * 4e3 / unit))
    if kind is DIFFERENCE:  # Newman's rule is the squares, of which the body has half as much besides
        one, two, value = seen[1]
        known = [(w, v) for w, v in pairs if v < 0.7 + 1e-9]
        assert np.stack([one, two], axis=1) == pytest.approx(np.array(known))
        assert value == pytest.approx(np.full(len(known), np.log10(1 / 1.5)))
