"""Pages of curves: rounding is no curve, and a legend is there where something follows it."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from hakobune.bem import DOFS
from hakobune.bem.database.resonances import Resonance
from hakobune.meshing.shapes import buoy
from hakobune.pipelines.common.gaps import gaps_of
from hakobune.pipelines.view.plots import _cut, plot, shown_headings

ZERO = "zero"
SURGE, SWAY, HEAVE, ROLL, PITCH, YAW = range(6)
NOISE = 1e-15


class Results(SimpleNamespace):
    """As much of a database as a page takes: a buoy with rounding where symmetry makes zero"""

    omega, wave_direction = np.array([0.3, 0.6, 0.9]), np.zeros(1)
    asked, rows, radiating_dof = omega, np.ones(3, bool), DOFS
    mesh, water_depth, path = buoy(10, 8, panels=60), 12.0, Path("buoy.h5")

    def __getitem__(self, name):
        return self.radiating_dof if name.endswith("_dof") else self.values[name]

    @property
    def names(self):
        return list(self.values)


@pytest.fixture
def page(tmp_path):
    """Draws values and returns ({row of the page: axes}, figure)"""

    def draw(more=(), **values):
        figure = plot(Results(values=values, **dict(more)), tmp_path / "page.png")
        return np.reshape(figure.axes[: 6 * (len(figure.axes) // 6)], (-1, 6)), figure

    return draw


def words(axis):
    return [text.get_text() for text in axis.texts]


def coefficients(largest, turning):
    return np.array(3 * [np.diag([largest, largest, largest, *turning])])


def test_coefficients_that_are_rounding_are_zero_by_symmetry(page):
    (axes,), _ = page(
        added_mass=coefficients(2e6, (4e7, 4e7, 2e6 * NOISE)), radiation_damping=coefficients(1e6, (1e6, 1e6, 1e-27))
    )
    assert [ZERO in words(axis) for axis in axes] == 5 * [False] + [True]
    assert [len(axis.lines) for axis in axes] == 5 * [2] + [0]


def test_frequencies_that_are_not_solved_are_a_gap_in_every_curve(page):
    """Five asked for, the fourth not solved: no curve has a value between the third and the fifth"""
    asked, rows = np.array([0.2, 0.3, 0.6, 0.7, 0.9]), np.array([False, True, True, False, True])
    (axes,), _ = page({"asked": asked, "rows": rows}, added_mass=coefficients(2e6, (4e7, 4e7, 4e7)))
    at, curve = axes[0].lines[0].get_data()
    inside = (at > 0.6) & (at < 0.9)
    assert inside.any() and np.all(np.isnan(curve[inside])) and np.isfinite(curve[~inside]).all()
    assert len(axes[0].patches) == 2 and axes[0].get_xlim()[0] < 0.2
    made = Results(values={"added_mass": coefficients(2e6, (4e7, 4e7, 4e7))}, asked=asked, rows=rows)
    (line,) = gaps_of(made).words()
    assert "2 of 5 frequencies are not solved, 0.2 to 0.7 rad/s; 'hakobune solve SCENE --output buoy.h5'" in line


def test_numbers_that_are_not_known_are_no_zeros_of_symmetry(page):
    """NaN of one motion: said, and the other curves are drawn"""
    values = coefficients(2e6, (4e7, 4e7, 4e7))
    values[:, ROLL, ROLL] = np.nan
    (axes,), _ = page(added_mass=values)
    assert words(axes[ROLL]) == ["not solved"] and [len(axis.lines) for axis in axes] == [1, 1, 1, 0, 1, 1]
    (line,) = gaps_of(Results(values={"added_mass": values})).words()
    assert "added_mass of roll is not a number at all frequencies" in line


def test_a_body_that_turns_without_moving_water_has_no_curves_of_moments(page):
    (axes,), _ = page(added_mass=coefficients(2e6, (1e-6, 2e-6, 3e-7)))  # a sphere about its centre
    assert [len(axis.lines) for axis in axes] == [1, 1, 1, 0, 0, 0]
    assert axes[SURGE].get_legend() is not None


@pytest.mark.parametrize("turn", [1.0, 1e-4])
def test_a_small_moment_that_is_none_of_rounding_is_drawn(page, turn):
    (axes,), _ = page(added_mass=coefficients(2e6, (4e7, 4e7, 4e7 * turn)))
    assert len(axes[YAW].lines) == 1 and words(axes[YAW]) == []


def test_mean_drift_that_is_rounding_is_zero_by_symmetry(page):
    drift = np.array([[[1e5, 1e5 * NOISE, 1e-12]]] * 3)
    (axes,), _ = page(drift_force=drift, drift_force_fixed=drift)
    assert len(axes[SURGE].lines) == 3  # two curves and the axis
    assert all(words(axes[i]) == [ZERO] and not axes[i].lines for i in (SWAY, YAW))


def test_a_moment_of_drift_is_measured_by_force_times_length(page):
    drift = np.array([[[1e5, 0.0, 1e3]]] * 3)
    (axes,), _ = page(drift_force=drift)
    assert len(axes[YAW].lines) == 2


@pytest.mark.parametrize("name", ["excitation_force", "rao"])
def test_excitation_and_responses_of_moments_that_are_all_rounding_are_not_drawn(page, name):
    axes, _ = page(**{name: np.array([[[1.0, 0, 1, 0, NOISE, 0]]] * 3) * (1 + 1j)})
    assert [len(axis.lines) for axis in axes[0]] == [1, 0, 1, 0, 0, 0]


def test_phases_of_forces_that_are_those_of_the_mesh_are_not_drawn(page):
    force = np.ones((3, 1, 6), complex) * [1.0, 1.0, 1.0, 1.0, 1.0, 1.0]
    force = np.concatenate([force, force * [1e-4, 1, 1, 1, 1, 1]], axis=1)
    Results.wave_direction, before = np.array([0.0, 0.5]), Results.wave_direction
    axes, _ = page(excitation_force=force)
    Results.wave_direction = before
    assert [len(axis.lines) for axis in axes[0]] == 6 * [2] and [len(axis.lines) for axis in axes[1]] == [1, *5 * [2]]


@pytest.mark.parametrize("planes, shown", [("xy", [0, 1, 2, 3]), ("y", [0, 2, 3, 4, 6]), ("", [0, 3, 5, 8, 11])])
def test_five_headings_are_drawn_at_most_of_those_that_mirror_planes_leave_different(planes, shown):
    headings = np.radians(np.arange(0, 360, 30))
    drawn = shown_headings(headings, planes)
    assert len(drawn) == len(shown) <= 5
    if planes:
        assert drawn.tolist() == shown


def test_a_peak_is_written_with_the_resonance_that_it_is_of():
    """Roll is sharp, and heave so damped that its width reaches over the peak of roll"""
    roll, heave = (Resonance(mode, omega, damping, 1.0, 0.0, 0.0, False, "")
                   for mode, omega, damping in ((ROLL, 0.21, 0.002), (HEAVE, 0.35, 0.24)))  # fmt: skip
    omega = np.linspace(0.1, 1.0, 91)
    size = 1 + 279 * np.exp(-(((omega - 0.21) / 0.01) ** 2))[:, None]
    axis = Figure().add_subplot()
    axis.plot(omega, size[:, 0])
    _cut(axis, [roll, heave], omega, size)
    assert words(axis) == ["280 at 0.21 rad/s\ndamping ratio 0.002"] and 4 < axis.get_ylim()[1] < 10


def test_headings_are_named_only_where_something_depends_on_them(page):
    _, figure = page(added_mass=coefficients(2e6, (4e7, 4e7, 4e7)))
    assert not figure.legends
    _, figure = page(excitation_force=np.ones((3, 1, 6), complex))
    assert figure.legends[0].get_title().get_text() == "waves travel to"
