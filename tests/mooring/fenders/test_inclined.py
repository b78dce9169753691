"""Fenders under an inclined face: by hand, by strips, in the limits, and what they give back."""

import math

import numpy as np
import pytest

from hakobune.mooring.fenders.families import fender_of_family
from hakobune.mooring.fenders.fender import FenderError, fender_of_points
from hakobune.mooring.fenders.hysteresis import followed
from hakobune.mooring.fenders.inclined import inclined

CELL = fender_of_family("cell", 2.0)
ANGLE, WIDTH = math.radians(8.0), 2.4
DEPTH = WIDTH * math.tan(ANGLE)


def test_a_linear_spring_under_an_inclined_face_is_known_by_hand():
    """k δ²/2a until the face lies on, k (δ − a/2) then; energy k/2 [(δ − a/2)² + a²/12]"""
    k = 3e6
    spring = inclined(fender_of_points("spring", 2.0, [0.0, 1.0], [0.0, k]), WIDTH, ANGLE)
    x = np.linspace(0.0, 1.0, 101)
    whole = x >= DEPTH
    assert spring.reaction(x) == pytest.approx(np.where(whole, k * (x - DEPTH / 2), k * x**2 / (2 * DEPTH)), rel=1e-3)
    wanted = 0.5 * k * ((x - DEPTH / 2) ** 2 + DEPTH**2 / 12)
    assert spring.energy(x)[whole] == pytest.approx(wanted[whole], rel=1e-5)


def test_reaction_and_energy_are_those_of_many_fenders_behind_a_stiff_panel():
    """Energy by their sum, which converges at second order in their number; reaction to what its table has, 1e-4"""
    made, x = inclined(CELL, WIDTH, ANGLE), np.linspace(0.1, CELL.limit, 12)
    off = []
    for count in (20, 40, 80):
        less = (np.arange(count) + 0.5) / count * DEPTH
        each = np.maximum(x[:, None] - less, 0.0)
        sums = CELL.reaction(each).mean(axis=1), CELL.energy(each).mean(axis=1)
        off.append([np.abs(a / b - 1).max() for a, b in zip(sums, (made.reaction(x), made.energy(x)), strict=True)])
    reaction, energy = np.transpose(off)
    assert np.all(np.log2(energy[:-1] / energy[1:]) > 1.9) and energy[-1] < 5e-4, off
    assert np.all(np.diff(reaction) < 0) and reaction[-1] < 2e-4, off


def test_a_face_that_is_hardly_inclined_presses_the_upright_fender():
    x = np.linspace(0.01, CELL.limit, 50)
    off = [np.abs(inclined(CELL, WIDTH, a).energy(x) - CELL.energy(x)).max() / CELL.rated_energy for a in (2e-2, 1e-2)]
    assert inclined(CELL, WIDTH, 0.0) is CELL and 1.8 < off[0] / off[1] < 2.2
    shares = [inclined(CELL, WIDTH, math.radians(a)).rated_energy / CELL.rated_energy for a in (0, 3, 6, 12, 24)]
    assert np.all(np.diff(shares) < 0)


def test_an_inclined_fender_gives_no_energy_back_and_its_strips_have_one_state():
    made = inclined(CELL, WIDTH, ANGLE)
    path = np.concatenate([np.linspace(0.4, 0.9, 200), np.linspace(0.9, 0.82, 60), np.linspace(0.82, 0.95, 60),
                           np.linspace(0.95, 0.4, 200)])  # fmt: skip
    one = followed(made, np.concatenate([np.linspace(0, 0.4, 50), path]))[0][50:]
    less = (np.arange(200) + 0.5) / 200 * DEPTH
    strips = [followed(CELL, np.maximum(np.concatenate([np.linspace(0, 0.4, 50), path]) - s, 0.0))[0] for s in less]
    assert one == pytest.approx(np.mean(strips, axis=0)[50:], rel=1e-3)
    assert np.all(made.unloading(path) <= made.loading(path) * (1 + 1e-12))
    assert made.returned(0.9) < made.energy(0.9)


def test_overload_of_an_inclined_fender_goes_on_with_its_stiffness():
    made = inclined(fender_of_family("cell", 2.0, overload=2e7), WIDTH, ANGLE)
    assert made.limit == CELL.limit and float(made.reaction(3.0) - made.reaction(2.9)) == pytest.approx(2e6, rel=1e-6)


@pytest.mark.parametrize("angle, width", [(-0.1, 2.0), (0.9, 2.0), (math.nan, 2.0), (0.1, 0.0), (0.1, math.inf)])
def test_an_impossible_face_is_refused_in_one_line(angle, width):
    with pytest.raises(FenderError, match="allowed: ") as caught:
        inclined(CELL, width, angle)
    assert "\n" not in str(caught.value)
