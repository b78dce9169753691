"""Static lines against quadrature down the line, and the tendencies that the design charts of the report show.

SR179 report (1982), section 3.1.7: its curves are lost, its text gives the orderings.
"""

from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import fsolve

from hakobune.mooring.lines.multi_segment.line import Bed, PointLoad, Segment, StaticLine

NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)


def cuts_of(line):
    """Places from the fairlead down where something changes: (s, weight of the point load there)."""
    ends = {float(s): 0.0 for s in np.cumsum([segment.length for segment in line.segments])}
    ends |= {load.position: load.weight for load in line.loads} | {0.0: 0.0}
    return sorted(ends.items(), reverse=True)


def segment_at(line, s):
    ends = np.cumsum([segment.length for segment in line.segments])
    return line.segments[int(np.searchsorted(ends, s))]


def hung(H, V, length, segment):
    """x, z covered by a free piece of a line, by Gauss quadrature of dx/ds and dz/ds."""
    v = V - segment.weight * 0.5 * length * (1 + NODES)
    T = np.hypot(H, v)
    stretch = 0.5 * length * WEIGHTS * (1 + T / segment.axial_stiffness) / T
    return stretch @ np.full_like(v, H), stretch @ v


def dragged(T, length, segment, friction):
    """x covered on a flat bed, and the tension left."""
    pulled = min(length, T / (friction * segment.weight))
    low = T - friction * segment.weight * pulled
    return length + 0.5 * (T + low) * pulled / segment.axial_stiffness, low


def shot(line, H, V, x, z):
    """Height of the point of touchdown and distance from the anchor, where a line with these forces ends.

    A buoy still to come keeps the line off the bed.
    """
    friction, on_bed, T = line.bed.friction, False, H
    touched = np.nan
    cuts = cuts_of(line)
    for (s, weight), (below, _) in pairwise(cuts):
        segment = segment_at(line, 0.5 * (s + below))
        length = s - below
        held_up = any(load.weight < 0 and load.position < s for load in line.loads)
        if not on_bed:
            on_bed = 0 < V <= weight
            V -= weight
            touched = z if on_bed else touched
            T = max(H + friction * V, 0.0) if on_bed else H
        else:
            T = max(T - friction * weight, 0.0)
        if not on_bed:
            free = min(length, V / segment.weight) if V > 0 and not held_up else length
            dx, dz = hung(H, V, free, segment)
            x, z, V, length = x - dx, z - dz, V - segment.weight * free, length - free
            if length > 0:
                on_bed, touched = True, z
        if on_bed:
            dx, T = dragged(T, length, segment, friction)
            x -= dx
    return np.array([touched if on_bed else z, x])


CHAIN, ROPE = Segment(150.0, 1000.0, 5e8), Segment(120.0, 200.0, 8e7)
MADE_UP = {
    "two segments": ([CHAIN, ROPE], [], 245.0),
    "clump": ([CHAIN, ROPE], [PointLoad(170.0, 2e4)], 245.0),
    "buoy": ([CHAIN, ROPE], [PointLoad(200.0, -2e4)], 245.0),
    "clump and buoy": ([CHAIN, ROPE, CHAIN], [PointLoad(160.0, 3e4), PointLoad(300.0, -3e4)], 385.0),
    "lifted": ([CHAIN, ROPE], [PointLoad(150.0, 1e4)], 259.0),
}


@pytest.mark.parametrize("name", MADE_UP)
def test_a_line_of_many_parts_is_the_one_that_quadrature_shoots_to_the_anchor(name):
    segments, loads, x = MADE_UP[name]
    line = StaticLine(segments, loads, Bed.sloping(0.0, 0.5))
    found = line.solve(x, 80.0)
    F = np.array([found.horizontal_fairlead, found.vertical_fairlead])
    assert np.abs(shot(line, *F, x, 80.0)).max() < 1e-11 * line.length
    start = F * [1.003, 0.998]
    root = fsolve(lambda f: shot(line, *(f * F), x, 80.0), start / F, xtol=1e-11) * F
    assert np.abs(root - F).max() < 1e-9 * found.tension_fairlead


def tension(share, scope=6.0, bed=None, loads=(), stiffness=np.inf, surface=np.inf):
    """A line of 10 N/m from 20 m above its anchor, at a share of the span that a straight line would have."""
    length = 20.0 * scope
    line = StaticLine([Segment(length, 10.0, stiffness)], loads, bed or Bed.sloping(), surface)
    return line.solve(np.asarray(share) * np.sqrt(length**2 - 400.0), 20.0)


def over_weight(found):
    return found.tension_fairlead / found.line.weight


def test_a_longer_scope_pulls_later_and_then_harder():
    """Chart 3.1.7.2; scopes 2 to 10 on a flat bed."""
    share = np.array([0.90, 0.95, 0.97])
    curves = np.array([over_weight(tension(share, scope)) for scope in (2, 3.26, 4, 6, 8, 10)])
    assert np.all(np.diff(curves, axis=0) < 0)
    late = np.array([over_weight(tension([0.97, 0.999], scope)) for scope in (2, 3.26, 4, 6, 8, 10)])
    assert np.all(np.diff(late[:, 1] / late[:, 0]) > 0)


def test_on_a_falling_bed_the_tension_rises_more_gently():
    """Chart 3.1.7.3; scope 6, slopes as the text lists them: as if the scope were smaller."""
    slopes = (-1 / 10, -1 / 20, -1 / 50, -1 / 100, 0.0, 1 / 100, 1 / 50, 1 / 20, 1 / 10)
    curves = np.array([over_weight(tension([0.95, 0.9995], bed=Bed.sloping(np.arctan(t)))) for t in slopes])
    assert np.all(np.diff(curves[:, 0]) < 0)
    assert np.all(np.diff(curves[:, 1] / curves[:, 0]) > 0)


def test_friction_takes_its_share_of_the_anchor_tension_and_nothing_at_the_fairlead():
    """Chart 3.1.7.1; scope 3.26, flat, inextensible: T at the anchor is H − μ w × length on the bed, at least 0."""
    smooth = tension(0.95, 3.26)
    for friction in (0.2, 0.5, 1.0, 3.0):
        found = tension(0.95, 3.26, Bed.sloping(0.0, friction))
        expected = max(0.0, smooth.horizontal_fairlead - friction * 10.0 * smooth.grounded_length)
        assert np.isclose(found.tension_fairlead, smooth.tension_fairlead, rtol=1e-12)
        assert abs(found.tension_anchor - expected) < 1e-10 * smooth.tension_fairlead


def hills(count, rising, steep=0.1, width=120.0):
    """Triangular hills of one steepness, or, not rising at the anchor, hollows."""
    x = np.linspace(0, width, 2 * count + 1)
    z = np.where(np.arange(x.size) % 2 == 1, steep * width / (2 * count), 0.0)
    return Bed(np.column_stack([x, z if rising else -z]))


def test_one_hill_is_lowest_one_hollow_highest_and_many_of_either_are_flat():
    """Chart 3.1.7.4: hills of one steepness, ever lower as they become more."""
    flat = over_weight(tension(0.97))
    over = np.array([over_weight(tension(0.97, bed=hills(n, True))) - flat for n in (1, 2, 4, 8, 16)])
    through = np.array([over_weight(tension(0.97, bed=hills(n, False))) - flat for n in (1, 2, 4, 8, 16)])
    assert over[0] == over.min() < 0 < through[0] == through.max()
    assert np.all(np.abs([over[-1], through[-1]]) < 0.1 * np.abs([over[0], through[0]]))


def test_a_sinker_stiffens_the_line_where_it_lifts():
    """Chart 3.1.7.5: nothing while it lies; a steeper rise as it lifts; then as a heavier line."""
    sinker = [PointLoad(60.0, 300.0)]
    share = np.linspace(0.90, 0.998, 197)
    plain, loaded = tension(share), tension(share, loads=sinker)
    lying = np.array([tension(s).grounded_length >= 60.0 for s in share])
    assert 0 < lying.sum() < share.size
    assert np.allclose(plain.tension_fairlead[lying], loaded.tension_fairlead[lying], rtol=1e-12)
    assert np.all(loaded.tension_fairlead[~lying] > plain.tension_fairlead[~lying])
    first = int(np.argmin(lying))
    assert loaded.stiffness[first, 0, 0] > plain.stiffness[first, 0, 0]


def test_a_small_buoy_makes_the_line_lighter_and_a_large_one_comes_up():
    """Chart 3.1.7.5, the weight of the line being 1200 N."""
    share = np.array([0.95, 0.97, 0.99])
    small = tension(share, loads=[PointLoad(100.0, -100.0)], surface=22.0)
    assert np.all(small.tension_fairlead < tension(share).tension_fairlead)
    large = [tension(s, loads=[PointLoad(70.0, -1500.0)], surface=22.0) for s in (0.80, 0.995)]
    assert large[0].loads == ("floating",)
    assert tension(0.80, loads=[PointLoad(70.0, -300.0)], surface=22.0).loads == ("submerged",)


def random_lines(count, seed):
    """Lines with a sinker and a buoy over beds of five points, and their fairleads."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        bx = np.cumsum(np.append(0.0, rng.uniform(10, 40, 4)))
        bed = Bed(np.column_stack([bx, np.append(0.0, rng.uniform(-8, 8, 4))]), rng.choice([0.0, 0.5]))
        x = rng.uniform(0.6, 1.0) * bx[-1]
        z = -float(bed.depth_below(x, 0.0)) + rng.uniform(10, 30)
        length = np.hypot(x, z) * rng.uniform(1.02, 1.3)
        weights = rng.uniform(0, 300), -rng.uniform(0, 300)
        loads = [PointLoad(length * rng.uniform(0.2, 0.9), weight) for weight in weights]
        yield StaticLine([Segment(length, 10.0, 1e6)], loads, bed, surface=z + 2), x, z


def test_lines_with_sinker_and_buoy_are_found_over_any_bed_and_lie_on_it_or_above():
    for line, x, z in random_lines(200, 5):
        found = line.solve(x, z)
        _, px, pz, T = found.profile(201).T
        assert line.bed.depth_below(px, pz).min() > -1e-9 * line.length
        assert np.abs([px[-1] - x, pz[-1] - z]).max() < 1e-9 * line.length
        assert np.abs([px[0], pz[0]]).max() < 1e-9 * line.length
        assert T.min() >= 0
        if not (line.bed.friction or found.slack):
            assert abs(found.stiffness[0, 1] - found.stiffness[1, 0]) < 1e-6 * np.abs(found.stiffness).max()


def test_the_length_left_over_at_the_anchor_grows_with_the_tension_beside_a_sinker_that_touches_its_own_place():
    """Below a sinker a span begins parallel to the bed: rounding there is no contact from which to leave it."""
    from hakobune.mooring.lines.multi_segment.line_data import workspace_for
    from hakobune.mooring.lines.multi_segment.traverse import traverse

    line, x, z = list(random_lines(59, 5))[-1]
    data = line._data
    left = [traverse(data, workspace_for(data), tension, x, z) for tension in np.linspace(440.0, 505.0, 200)]
    assert np.all(np.diff(left) > 0)


def edges(found):
    """Pieces above and below a sinker from which the line, lying above it, rises towards its anchor."""
    p = found.pieces[found.pieces[:, 2] > 0]
    places = [load.position for load in found.line.loads if load.weight > 0]
    return [(a, b) for a, b in pairwise(p) if a[0] == 1 and b[0] == 0 and b[1] in places]


def test_a_sinker_at_the_edge_of_what_lies_presses_within_its_weight():
    """The bed makes up the balance of a sinker between a line that lies and one that a buoy lifts beyond it."""
    seen = pulled = 0
    for line, x, z in random_lines(200, 5):
        sinker = max(load.weight for load in line.loads)
        for above, below in edges(line.solve(x, z)):
            seen += 1
            beta, T = above[10], above[5] - above[6] * above[2]
            along, across = np.array([np.cos(beta), np.sin(beta)]), np.array([-np.sin(beta), np.cos(beta)])
            reaction = np.array([0.0, sinker]) + below[5:7] - T * along
            pressure, grip = reaction @ across, -reaction @ along
            assert -1e-9 * sinker <= pressure <= sinker * np.cos(beta) * (1 + 1e-9)
            # what has no pull left lies where it is, on any slope
            if np.hypot(*below[5:7]) > 1e-6 * line.weight:
                assert abs(grip) <= line.bed.friction * pressure + 1e-9 * sinker
                pulled += 1
    assert seen >= pulled >= 5, (seen, pulled)
