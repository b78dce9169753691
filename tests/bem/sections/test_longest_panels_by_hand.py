"""How long panels of a section may be, so that sections of a few frequencies share them."""

from types import SimpleNamespace

import numpy as np
import pytest
from exact.water_waves import wavenumber

from hakobune.bem.sections import any_section, bending, deep_water, keel_loss, side_by_side
from hakobune.bem.sections.outline import Edge, rectangle


class Asked(Exception):
    pass


@pytest.mark.parametrize("omega", [0.3, 0.9, 1.7, 2.4])
@pytest.mark.parametrize("module, ask", [
    (any_section, lambda w: any_section.section_flow(rectangle(10.0, 6.0).wetted(3.0), 12.0, w, 9.81, 1e-3)),
    (side_by_side, lambda w: side_by_side.flow_of([(rectangle(10.0, 6.0).wetted(3.0), 0.0)], 12.0, w, 0.0, 9.81, 1e-3)),
    (bending, lambda w: bending.bending_strip(10.0, 1e6, 50.0, 12.0, w, gravity=9.81, tolerance=1e-3)),
])  # fmt: skip
def test_the_longest_panel_is_the_power_of_two_below_four_radians_of_the_wave(monkeypatch, omega, module, ask):
    heard = []

    def shape(edges, depth, longest, tolerance):
        heard.append((depth, longest, tolerance))
        raise Asked

    monkeypatch.setattr(module, "shape", shape)
    with pytest.raises(Asked):
        ask(omega)
    k = wavenumber(omega, 12.0, 9.81)
    ((depth, longest, tolerance),) = heard
    assert (depth, tolerance) == (12.0, 1e-3)
    assert np.log2(longest) == pytest.approx(round(np.log2(longest))) and longest <= 4 / k < 2 * longest


def test_motions_of_sections_side_by_side_know_their_own_section(monkeypatch):
    """By the middle of the gap between two, whatever their sides"""
    sections = [(rectangle(4.0, 6.0).wetted(3.0), -6.0), (rectangle(2.0, 6.0).wetted(3.0), 1.0),
                (rectangle(2.0, 6.0).wetted(3.0), 5.0)]  # fmt: skip
    points = np.array([-8.0 - 1j, -4.0, -2.1, -1.9, 0.0, 2.9, 3.1 - 2j, 6.0])  # gaps from −4 to 0 and from 2 to 4
    made = SimpleNamespace(points=np.append(points, 99.0), normals=np.append(1j * points, 0.0),
                           body=np.append(np.ones(8, bool), False))  # fmt: skip
    monkeypatch.setattr(side_by_side, "shape", lambda *given: made)
    monkeypatch.setattr(side_by_side, "AnyFlow", lambda *given: given)
    *rest, found = side_by_side.flow_of(
        sections, 12.0, 1.0, 0.05, 9.81, 1e-3, lambda p, n, owner: (p.tolist(), n.tolist(), owner.tolist())
    )
    assert rest == [made, 1.0, 9.81, 0.05]
    assert found == (points.tolist(), (1j * points).tolist(), [0, 0, 0, 1, 1, 1, 2, 2])


ARC = Edge(-2 + 0j, 2 + 0j, 1.0)  # half a circle of 2 m, turning left


@pytest.mark.parametrize("edge, first, last, longest, cuts", [
    (Edge(0j, 8 + 0j), 0, 0, 8.1, [0, 1]), (Edge(0j, 8 + 0j), 0, 0, 8.0, [0, 1]),
    (Edge(0j, 8 + 0j), 0, 0, 7.9, [0, 0.5, 1]), (Edge(0j, 8 + 0j), 0, 0, 2.0, [0, 0.25, 0.5, 0.75, 1]),
    (Edge(0j, 8 + 0j), 2, 0, 8.0, [0, 1 / 16, 1 / 4, 1]), (Edge(0j, 8 + 0j), 0, 2, 8.0, [0, 3 / 4, 15 / 16, 1]),
    (Edge(0j, 8 + 0j), 2, 1, 8.0, [0, 1 / 8, 1 / 2, 1]), (Edge(0j, 8 + 0j), 1, 2, 8.0, [0, 1 / 2, 7 / 8, 1]),
    (Edge(0j, 8 + 0j), 1, 0, 3.0, [0, 1 / 4, 5 / 8, 1]),
    (ARC, 0, 0, 99.0, [0, 1 / 3, 2 / 3, 1]), (ARC, 0, 0, 1.6, [0, 0.25, 0.5, 0.75, 1]),
])  # fmt: skip
def test_panels_shrink_four_times_each_towards_corners_and_span_a_sixth_of_a_circle_at_most(
    edge, first, last, longest, cuts
):
    """Towards both ends they meet in the middle"""
    found = any_section._panels(edge, first, last, longest)
    ends = [complex(edge.at(u)) for u in cuts]
    assert [one.start for one in found] == pytest.approx(ends[:-1])
    assert [one.end for one in found] == pytest.approx(ends[1:])
    for one in found:
        assert one.angle == pytest.approx(edge.angle * one.length / edge.length)


@pytest.mark.parametrize("turn, tolerance, levels, exponent", [
    (np.pi / 2, 1e-5, 5, 2 / 3), (-np.pi / 2, 1e-5, 3, 2.0), (np.pi / 2, 1e-3, 3, 2 / 3), (0.9e-3, 1e-5, 0, 1.0),
    (-0.9e-3, 1e-5, 0, 1.0), (np.pi / 2, 0.19, 1, 2 / 3), (1.05e-3, 1e-5, 4, 1 / (1 + 1.05e-3 / np.pi)),
])  # fmt: skip
def test_a_corner_has_as_many_panels_as_its_flow_needs(turn, tolerance, levels, exponent):
    """φ ~ d^(π/β): ln(0.2/tolerance) over (1 + π/β) ln 4, β of the water on the right, of a half plane none"""
    chain = [Edge(0j, 1 + 0j), Edge(1 + 0j, 1 + np.exp(1j * turn))]
    found = any_section._levels(chain, 0, tolerance)
    assert found[0] == levels and found[1] == pytest.approx(exponent)
    if levels > 1:
        assert levels == np.ceil(np.log(0.2 / tolerance) / ((1 + exponent) * np.log(4)))


def test_a_section_of_too_many_panels_is_refused(monkeypatch):
    wetted = rectangle(10.0, 6.0).wetted(3.0)
    chain = [Edge(-17 - 12j, -17 + 0j), Edge(-17 + 0j, -5 + 0j), *wetted.edges, Edge(5 + 0j, 17 + 0j),
             Edge(17 + 0j, 17 - 12j)]  # fmt: skip
    parts = any_section._split(chain, 12.0, 4.0, 1e-4)
    count = sum(map(len, parts))
    assert len(parts) == len(chain)
    assert [len(part) for part in parts] == [len(part) for part in parts[::-1]]  # of a symmetric section
    monkeypatch.setattr(any_section, "MOST_PANELS", count)
    any_section._split(chain, 12.0, 4.0, 1e-4)
    monkeypatch.setattr(any_section, "MOST_PANELS", count - 1)
    with pytest.raises(ValueError, match=rf"the section needs {count} panels at this frequency; allowed: {count - 1};"):
        any_section._split(chain, 12.0, 4.0, 1e-4)


def test_sections_side_by_side_are_one_chain_with_the_water_between_them():
    """Each moved to its place; from the left to the right, however many"""
    square = rectangle(2.0, 2.0).wetted(1.0)
    chain = side_by_side._chain([(square, -4.0), (square, 0.0), (square, 5.0)])
    corners = [-5 + 0j, -5 - 1j, -3 - 1j, -3, -1, -1 - 1j, 1 - 1j, 1, 4, 4 - 1j, 6 - 1j, 6]
    assert [edge.start for edge in chain] == pytest.approx(corners[:-1])
    assert [edge.end for edge in chain] == pytest.approx(corners[1:])
    with pytest.raises(ValueError, match=r"a section ends at y = 1 m, and the next begins at 0\.9 m; leave a gap"):
        side_by_side._chain([(square, -4.0), (square, 0.0), (square, 1.9)])


@pytest.mark.parametrize("depth", [6.0, 12.0])
def test_what_pushes_the_water_under_the_keel_is_pushed_by_it(depth):
    """Green's identity of g, ±1 on both halves of a gap of height s, and the flow of a motion: ∮ φ_g n dl = −2s U"""
    flow = keel_loss.keel_flow(10.0, 4.0, depth, 0.7, tolerance=1e-4)
    assert flow.force == pytest.approx(-2 * (depth - 4.0) * flow.moved, rel=1e-9)
    assert flow.moved[1] == 0 and abs(flow.moved[2]) > 0.5 * abs(flow.moved[0])


def test_a_resistance_under_the_keel_leaves_no_reciprocity():
    """Haskind's relation does not hold with losses: nothing is told of it; the rest is there"""
    flow = keel_loss.keel_flow(10.0, 4.0, 6.0, 0.7, tolerance=1e-4)
    lost = flow.resisted(2.0)
    assert np.isnan(lost.haskind).all() and lost.haskind.shape == (3,)
    assert np.isfinite(lost.excitation).all() and np.isfinite(lost.drift)
    free = flow.resisted(0.0)
    for name in ("added_mass", "damping", "excitation", "radiated", "radiated_back", "reflection", "transmission"):
        assert getattr(free, name) == pytest.approx(getattr(flow.section, name), rel=1e-9, abs=1e-9)
    assert free.drift == pytest.approx(flow.section.drift, rel=1e-4)


@pytest.mark.parametrize("omega", [0.9, 1.7, 2.4])
def test_in_deep_water_too_it_is_the_power_of_two_below_four_radians_of_the_wave(monkeypatch, omega):
    heard = []

    def contour(beam, draft, longest, tolerance):
        heard.append((beam, draft, longest, tolerance))
        raise Asked

    monkeypatch.setattr(deep_water, "contour", contour)
    with pytest.raises(Asked):
        deep_water.DeepFlow(8.0, 3.0, omega, 9.81, 1e-3)
    beam, draft, longest, tolerance = heard[0]
    assert (beam, draft, tolerance) == (8.0, 3.0, 1e-3)
    assert longest == 2.0 ** np.floor(np.log2(4 * 9.81 / omega**2))


def test_a_gap_under_any_section_that_is_too_thin_is_refused():
    with pytest.raises(ValueError, match=r"the gap under the keel .* is 8e-05 m; allowed: 9e-05 m or more"):
        any_section.section_flow(rectangle(10.0, 6.0).wetted(3.0), 3.00008, 0.7, 9.81, 1e-3)


@pytest.mark.parametrize("beam, draft, longest, bottom, side", [
    (8.0, 4.0, 16.0, 3.0, 1.5), (40.0, 2.0, 16.0, 3.75, 0.75), (2.0, 40.0, 16.0, 0.75, 1.875),
    (40.0, 40.0, 2.0, 1.875, 1.875),
])  # fmt: skip
def test_panels_in_deep_water_are_as_long_as_twice_what_is_beside_them_at_most(beam, draft, longest, bottom, side):
    """Ten points each; of b and of d/2 three quarters in as many equal parts as are no longer than 2d, and than B"""
    found = deep_water.contour(beam, draft, longest, 1e-4)
    lengths = found.weights.reshape(-1, 10).sum(axis=1)
    on_side = found.side.reshape(-1, 10).any(axis=1)
    assert lengths[~on_side].sum() == pytest.approx(beam / 2) and lengths[on_side].sum() == pytest.approx(draft)
    assert lengths[~on_side].max() <= min(longest, 2 * draft) and lengths[on_side].max() <= min(longest, beam)
    assert lengths[~on_side].max() == pytest.approx(bottom) and lengths[on_side].max() == pytest.approx(side, rel=0.35)
    assert found.y[found.side] == pytest.approx(np.full(found.side.sum(), beam / 2))
    assert found.z[~found.side] == pytest.approx(np.full((~found.side).sum(), -draft))
    assert np.all(np.diff(found.y[~found.side]) > 0) and np.all(np.diff(found.z[found.side]) > 0)


@pytest.mark.parametrize("tolerance, levels", [(1e-6, 5), (9e-7, 6), (1e-2, 3), (1e-4, 4)])
def test_panels_at_the_edge_in_deep_water_shrink_as_its_flow_needs_and_half_as_often_at_the_surface(tolerance, levels):
    """A quarter each, ⌈−0.4 log₄ tolerance⌉ + 1 of them"""
    found = deep_water.contour(8.0, 6.0, 99.0, tolerance)
    lengths, on_side = found.weights.reshape(-1, 10).sum(axis=1), found.side.reshape(-1, 10).any(axis=1)
    quarters = 4.0 ** -np.arange(levels, -1, -1)
    assert lengths[~on_side] == pytest.approx(4.0 * np.diff(np.append(0.0, quarters))[::-1])
    few = 4.0 ** -np.arange(levels // 2, -1, -1)
    wanted = np.concatenate([3.0 * np.diff(np.append(0.0, quarters)), 3.0 * np.diff(np.append(0.0, few))[::-1]])
    assert lengths[on_side] == pytest.approx(wanted)
    nodes = np.polynomial.legendre.leggauss(10)[0]
    first = 4.0 * (1 - 0.25) * (1 + nodes) / 2
    assert found.y[:10] == pytest.approx(first)


@pytest.mark.parametrize("beam, omega", [(4.0, 1.0), (30.0, 1.0), (30.0, 2.0)])
def test_points_inside_are_four_and_one_for_each_radian_of_the_wave_along_the_beam(monkeypatch, beam, omega):
    """On the waterline, by the golden ratio; they follow the points of the contour"""
    seen = []

    def kernels(self, y, z, sign):
        seen.append((self.contour, y, z))
        raise Asked

    monkeypatch.setattr(deep_water.DeepFlow, "_kernels", kernels)
    with pytest.raises(Asked):
        deep_water.DeepFlow(beam, 3.0, omega, 9.81, 1e-3)
    ((contour, y, z),) = seen
    inside = y[len(contour.y) :]
    assert len(inside) == 4 + np.ceil(omega**2 / 9.81 * beam) and not z[len(contour.y) :].any()
    golden = (np.sqrt(5) - 1) / 2
    assert inside == pytest.approx(beam / 2 * np.mod(golden * np.arange(1, len(inside) + 1), 1))
    assert np.array_equal(y[: len(contour.y)], contour.y) and np.array_equal(z[: len(contour.y)], contour.z)


@pytest.mark.parametrize("beam, draft, depth, tolerance", [
    (0.0, 1.0, 3.0, 1e-4), (4.0, -1.0, 3.0, 1e-4), (4.0, 3.0, 3.0, 1e-4), (4.0, 1.0, 3.0, 1.0),
])  # fmt: skip
@pytest.mark.parametrize("which", ["zero", "infinity"])
def test_limits_of_the_frequency_are_those_of_a_section(beam, draft, depth, tolerance, which):
    """With the words with which a section is refused"""
    from hakobune.bem.sections.coefficients import check_shape
    from hakobune.bem.sections.frequency_limits import added_mass_limit

    with pytest.raises(ValueError) as wanted:
        check_shape(beam, draft, depth, tolerance)
    with pytest.raises(ValueError) as refused:
        added_mass_limit(beam, draft, depth, which, tolerance=tolerance)
    assert str(refused.value) == str(wanted.value)


@pytest.mark.parametrize("depth, extra", [(3.1, 3), (9.0, 1), (3.5, 2)])
def test_panels_at_the_corners_of_a_bottom_shrink_to_what_is_beside_them(depth, extra):
    """Of 10 m beside a gap of 0.1 or 0.5 m, or sides of 3 m: ln(10/0.1)/ln 4 − ½ = 2.8, 1.7 and 0.4, more than the
    levels of the corner, so many times shorter by four; from both ends half of it"""
    wetted = rectangle(10.0, 6.0).wetted(3.0)
    chain = [Edge(-5 - depth - 1j * depth, -5 - depth + 0j), Edge(-5 - depth + 0j, -5 + 0j), *wetted.edges,
             Edge(5 + 0j, 5 + depth + 0j), Edge(5 + depth + 0j, 5 + depth - 1j * depth)]  # fmt: skip
    bottom = next(i for i, edge in enumerate(chain) if edge.start.imag == edge.end.imag == -3.0)
    level = any_section._levels(chain, bottom, 1e-4)[0]
    parts = any_section._split(chain, depth, 99.0, 1e-4)[bottom]
    assert min(one.length for one in parts) == pytest.approx(10 * 2 * 4.0 ** -(level + extra))
    assert sum(one.length for one in parts) == pytest.approx(10.0)
