"""The Green function and its derivative by either depth: by differences, and as where it is by one alone."""

import math

import numpy as np
import pytest
from plain import plain

forms, tables = plain("bem.green.finite_depth"), plain("bem.green.tables")
G = 9.80665


@pytest.mark.parametrize("depth", [20.0, np.inf])
def test_derivatives_by_both_depths_are_differences_in_each_zone_of_a_table(depth):
    table, h = tables.wave_table(0.9, depth, G, 80.0, 8.0, 1e-6), 1e-3
    view, q = forms.table_view(table), math.exp(-table.k * table.double_depth) if np.isfinite(depth) else 0.0

    def at(R, z, zeta):
        depths, back = forms.depth_variables(z, zeta), forms.depth_variables(zeta, z)
        wave, slope = forms.wave_factors(*depths, table.C, table.k, q)
        _, slope_back = forms.wave_factors(*back, table.C, table.k, q)
        place = forms.table_position(R, depths, view)
        return forms.standing_part_at(place, R, depths, wave, slope, slope_back, view), forms.wave_part_at(
            place, R, depths, wave, slope, view
        )[:3]

    zones = set()
    for R, z, zeta in (
        (1.5, -2.0, -3.0),
        (9.0, -6.0, -1.0),
        (25.0, -1.5, -4.0),
        (45.0, -3.0, -7.0),
        (70.0, -5.0, -2.0),
    ):
        (g, gr, by_zeta, by_z), alone = at(R, z, zeta)
        zones.add(forms.table_position(R, forms.depth_variables(z, zeta), view)[0])
        assert (g, gr, by_zeta) == pytest.approx(alone, rel=1e-9, abs=1e-12)
        size = max(abs(g), 1e-3)
        for found, step in ((gr, (h, 0, 0)), (by_zeta, (0, 0, h)), (by_z, (0, h, 0))):
            before, after = (at(*(np.array([R, z, zeta]) + side * np.array(step)))[0][0] for side in (-1, 1))
            assert found == pytest.approx((after - before) / (2 * h), abs=2e-4 * size)
    assert len(zones) > 2 or not np.isfinite(depth)


@pytest.mark.parametrize("depth", [20.0, 60.0])
def test_a_pair_by_a_table_is_the_function_without_its_images(depth):
    """G − 1/r − 1/r₂ − 1/r₃ of source and image above the surface and below the bed, whichever of both is deeper"""
    table = tables.wave_table(0.9, depth, G, 80.0, 18.0, 1e-6)
    for R, z, zeta in ((9.0, -6.0, -1.0), (9.0, -1.0, -6.0), (25.0, -15.0, -0.5), (45.0, -3.0, -17.0)):
        images = sum(1 / math.hypot(R, height) for height in (z - zeta, z + zeta, z + zeta + 2 * depth))
        depths, view = forms.depth_variables(z, zeta), forms.table_view(table)
        factors = forms.wave_factors(*depths, table.C, table.k, math.exp(-table.k * table.double_depth))
        found = forms.wave_part_at(forms.table_position(R, depths, view), R, depths, *factors, view)
        known = forms.green(R, zeta, z, 0.9, depth, G)
        assert found[0] == pytest.approx(known[0].real - images, abs=3e-7)
        heights = zeta - z, z + zeta, z + zeta + 2 * depth
        along = sum(-R / math.hypot(R, height) ** 3 for height in heights)
        upwards = sum(-height / math.hypot(R, height) ** 3 for height in heights)  # by ζ
        assert found[1] == pytest.approx(known[1].real - along, abs=1e-6)
        assert found[2] == pytest.approx(known[2].real - upwards, abs=1e-6)


@pytest.mark.parametrize("z, zeta", [(-2.0, -7.0), (-7.0, -2.0)])
def test_beyond_the_last_zone_less_the_wave_it_is_what_takes_the_images_away(z, zeta):
    """−1/r − 1/r₁ − 1/r₂ and their derivatives by either depth, where G less its wave is nothing"""
    table, R, h = tables.wave_table(0.9, 20.0, G, 5000.0, 8.0), 300.0, 20.0
    view, depths = forms.table_view(table), forms.depth_variables(z, zeta)
    position = forms.table_position(R, depths, view)
    assert position[0] >= table.entries
    found = forms.standing_part_at(position, R, depths, 0.0, 0.0, 0.0, view)
    heights = zeta - z, zeta + z, zeta + z + 2 * h
    r = [math.hypot(R, height) for height in heights]
    rising = [height / one**3 for height, one in zip(heights, r, strict=True)]
    assert found[0] == pytest.approx(-sum(1 / one for one in r), rel=1e-12)
    assert found[1] == pytest.approx(sum(R / one**3 for one in r), rel=1e-12)
    assert found[2] == pytest.approx(sum(rising), rel=1e-12)
    assert found[3] == pytest.approx(-rising[0] + rising[1] + rising[2], rel=1e-12)
    assert forms.wave_part_at(position, R, depths, 0.0, 0.0, view)[:3] == pytest.approx(found[:3], rel=1e-12)


def test_beyond_the_last_zone_the_limit_of_long_waves_has_its_logarithm():
    """(2/h) ln 2h/R and its slope, less the images, which are all there is of G besides"""
    table, R, z, zeta, h = tables.limit_table("zero", 20.0, 5000.0, 8.0), 300.0, -2.0, -7.0, 20.0
    Y, V, upwards = forms.depth_variables(z, zeta)
    g, gr, gz = forms._beyond(R, Y, V, upwards, forms.table_view(table))
    heights = zeta - z, zeta + z, zeta + z + 2 * h
    r = [math.hypot(R, height) for height in heights]
    assert table.net == 1 / h
    assert g == pytest.approx(2 / h * math.log(2 * h / R) - sum(1 / one for one in r), rel=1e-12)
    assert gr == pytest.approx(-2 / (h * R) + sum(R / one**3 for one in r), rel=1e-12)
    assert gz == pytest.approx(sum(height / one**3 for height, one in zip(heights, r, strict=True)), rel=1e-9)
