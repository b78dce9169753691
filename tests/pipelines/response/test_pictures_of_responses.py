"""Pictures of responses in a sea and in a climate, whose spectra are set by hand: units, panels, axes, years."""

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.response.climate import Climate
from hakobune.mooring.response.linear import Moments
from hakobune.mooring.response.sea_state import SeaState, SlowForces
from hakobune.pipelines.response.plot import draw

OMEGA = np.array([0.4, 0.6, 0.8])
NAMES = ("surge", "roll", "deck acceleration x", "deck acceleration z", "sway")
UNITS = ("m", "rad", "m/s²", "m/s²", "m")


def sea_state(slow=None):
    """σ² of 1, 2, 3 and 4 in the units; sway does not move"""
    spectrum = np.outer([1.0, 3.0, 2.0], [1.0, 1e-4, 3.0, 4.0, 0.0])
    m0 = np.array([1.0, 2.0, 3.0, 4.0, 0.0])
    moments = Moments(*(m0 for _ in Moments._fields))
    sea = Sea(issc(2.0, mean_period=8.0), np.pi)
    return SeaState(sea, 3600.0, (), NAMES, UNITS, OMEGA, spectrum, moments, slow, None, ())


def test_spectra_are_in_degrees_and_metres_a_panel_for_a_motion_and_one_for_a_point(pictures, tmp_path):
    """(180/π)² of roll; what does not move has no panel; the points' axes share one, each in its colour"""
    found = draw(sea_state(), tmp_path / "p.png")
    assert pictures == [found]
    waves, surge, roll, deck, *empty = found.axes
    assert [one.get_title() for one in found.axes[:4]] == ["waves", "surge", "roll", "deck acceleration"]
    assert [one.get_ylabel() for one in found.axes[:4]] == ["m² s/rad", "m² s/rad", "°² s/rad", "(m/s²)² s/rad"]
    assert not any(one.axison for one in empty) and len(found.axes) == 6
    assert waves.lines[0].get_ydata() == pytest.approx(issc(2.0, mean_period=8.0).density(OMEGA))
    assert surge.lines[0].get_xydata() == pytest.approx(np.stack([OMEGA, [1.0, 3.0, 2.0]], axis=1))
    assert roll.lines[0].get_ydata() == pytest.approx(1e-4 * (180 / np.pi) ** 2 * np.array([1.0, 3.0, 2.0]))
    assert [line.get_label() for line in deck.lines] == ["x", "z"] and [line.get_color() for line in deck.lines] == [
        "C0",
        "C2",
    ]
    assert deck.lines[1].get_ydata() == pytest.approx([4.0, 12.0, 8.0])
    assert surge.get_legend() is None and [t.get_text() for t in deck.get_legend().get_texts()] == ["x", "z"]
    assert all(one.get_xlim()[0] == 0 and one.get_ylim()[0] == 0 for one in found.axes[:4])
    assert (
        found.get_suptitle().startswith("spectra: issc spectrum, 2 m") and "travelling to 180°" in found.get_suptitle()
    )


def test_the_slow_drift_force_has_a_panel_of_its_own_in_square_kilonewtons(pictures, tmp_path):
    difference = np.array([0.0, 0.1])
    slow = SlowForces(np.zeros(3), np.zeros((2, 3)), difference, np.array([[4e6, 9e6, 1e9], [1e6, 2e6, 1e9]]), None)
    found = draw(sea_state(slow), tmp_path / "p.png")
    drift = found.axes[4]
    assert drift.get_title() == "slow drift force" and drift.get_ylabel() == "kN² s/rad"
    surge, sway = drift.lines
    assert surge.get_xydata().tolist() == [[0.0, 4.0], [0.1, 1.0]] and sway.get_ydata().tolist() == [9.0, 2.0]
    assert (surge.get_label(), sway.get_label()) == ("surge", "sway") and drift.get_legend() is not None


def test_a_climate_is_drawn_as_times_a_year_that_a_level_is_passed(pictures, tmp_path):
    """One state all the year, σ = 2 and T_zero = 10 s: 365.25 · 8640 e^(−x²/8) a year, down to once in 1000 years"""
    rate = 365.25 * 86400 / 10
    sigma = np.array([2.0, np.radians(2.0), 1.0])
    m0 = (sigma**2)[None]
    climate = Climate(("surge", "roll", "sway"), ("m", "rad", "m"), np.ones(1), np.ones(1), np.zeros(1), np.ones(1), m0,
                      m0 * (2 * np.pi / 10) ** 2, None, ())  # fmt: skip
    found = draw(climate, tmp_path / "p.png")
    surge, roll, sway = found.axes
    assert found.get_suptitle() == "exceedance in 1 sea states"
    for axes, size, unit in ((surge, 2.0, "m"), (roll, 2.0, "°"), (sway, 1.0, "m")):
        x, times = axes.lines[0].get_data()
        assert times == pytest.approx(rate * np.exp(-0.5 * (x / size) ** 2), rel=1e-6)
        assert x[0] == 0 and x[-1] == pytest.approx(size * np.sqrt(2 * np.log(1000 * rate)), rel=1e-6)
        assert axes.get_xlabel() == unit and axes.get_ylabel() == "times a year" and axes.get_yscale() == "log"
        assert [line.get_ydata()[0] for line in axes.lines[1:]] == [1.0, 1 / 50] and axes.get_legend() is None
        assert axes.get_ylim()[0] == 1e-3 and axes.get_xlim()[0] == 0


def test_rows_of_three_panels_are_added_as_they_are_needed(pictures, tmp_path):
    """Nine motions of three bodies make three rows"""
    names = tuple(f"{body} {motion}" for body in "abc" for motion in ("surge", "heave", "roll"))
    m0 = np.ones((1, 9))
    climate = Climate(names, ("m", "m", "rad") * 3, *(np.ones(1) for _ in range(4)), m0, m0, None, ())
    found = draw(climate, tmp_path / "p.png")
    assert [one.get_title() for one in found.axes] == list(names) and found.get_size_inches()[1] == pytest.approx(8.6)
    assert found.axes[0].get_subplotspec().get_gridspec().nrows == 3


def test_levels_of_a_point_share_a_panel_with_a_legend(pictures, tmp_path):
    m0 = np.array([[1.0, 4.0]])
    climate = Climate(("deck x", "deck z"), ("m", "m"), *(np.ones(1) for _ in range(4)), m0, m0, None, ())
    found = draw(climate, tmp_path / "p.png")
    assert found.axes[0].get_title() == "deck"
    assert [text.get_text() for text in found.axes[0].get_legend().get_texts()] == ["x", "z"]
    x, z = (line.get_xdata()[-1] for line in found.axes[0].lines[:2])
    assert z == pytest.approx(2 * x)
