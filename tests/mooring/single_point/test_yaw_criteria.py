"""A tanker of 200 000 t at a single point: the published criteria of yaw stability beside our eigenvalues.

Particulars of Wichers, "A simulation model for a single point moored tanker" (Delft 1988): 310 × 47.17 × 18.9 m,
240 697 t, radius of gyration in yaw 79.3 m; derivatives by Clarke, Gedling and Hine (1983).
"""

import numpy as np
import pytest
from boxes import ANGLES, KNOT, RHO, buoy

from hakobune.mooring.loads.ship_derivatives import by_yaw_rate, clarke
from hakobune.mooring.single_point.body import SinglePoint
from hakobune.mooring.single_point.criterion import moored_quartic, roots, routh_hurwitz
from hakobune.mooring.single_point.equilibria import equilibria
from hakobune.mooring.single_point.loads import Loads, WaterLoad, still_table
from hakobune.mooring.single_point.yaw_criteria import straight_line, yaw_stability

LENGTH, BEAM, DRAFT, MASS, GYRATION = 310.0, 47.17, 18.9, 240.697e6, 79.3
SPEED = 2.0 * KNOT
SHIP = clarke(LENGTH, BEAM, DRAFT, MASS / (RHO * LENGTH * BEAM * DRAFT))
LINES = {"depth": 60.0, "weight": 2000.0, "tension": 4e5, "length": 1000.0}


def tanker(arm=155.0, hawser=60.0, ship=SHIP, drag=0.04):
    """SinglePoint in a current towards −x; its side force and moment near head on are those of the derivatives"""
    half = 0.5 * RHO * LENGTH**2
    added = 0.06 * MASS
    unit = np.zeros((len(ANGLES), 3))
    sin, cos = np.sin(ANGLES), np.cos(ANGLES)
    unit[:, 0] = drag * half * DRAFT / LENGTH * cos
    unit[:, 1] = half * (-ship.Y_v * sin * np.abs(cos) + 0.8 * DRAFT / LENGTH * sin**3)
    unit[:, 2] = half * LENGTH * ship.N_v * sin * cos
    table = still_table(unit)
    table[:, 1] = by_yaw_rate(ship, LENGTH, RHO, added, ANGLES)
    water = WaterLoad(table, LENGTH, False, SPEED, np.pi)
    inertia = MASS * GYRATION**2 - half * LENGTH**3 * ship.N_rdot
    mass = np.diag([MASS + added, MASS - half * LENGTH * ship.Y_vdot, inertia])
    return SinglePoint(Loads(water), mass, [(arm, 0.0)], [hawser], buoy(**LINES))


def head_on(point):
    return min(equilibria(point), key=lambda one: abs(np.sin(one.heading / 2)))


def test_derivatives_of_the_loads_are_those_of_the_ship():
    m, half = head_on(tanker()).lateral, 0.5 * RHO * LENGTH**2 * SPEED
    assert m.Y_v == pytest.approx(half * SHIP.Y_v, rel=1e-4) and m.N_v == pytest.approx(
        half * LENGTH * SHIP.N_v, rel=1e-4
    )
    assert m.N_r == pytest.approx(half * LENGTH**2 * SHIP.N_r, rel=1e-4)
    free = half * LENGTH * SHIP.Y_r - MASS * SPEED  # Y_r − mU of the body alone, about its own axes
    assert m.Y_r - m.mass * SPEED == pytest.approx(free, rel=1e-4)


@pytest.mark.parametrize("arm", [155.0, 60.0])
def test_the_quartic_of_a_ship_holds_the_roots_of_its_linear_motion(arm):
    one = head_on(tanker(arm))
    gap = np.abs(roots(one.quartic)[:, None] - one.roots).min(axis=1)
    assert gap.max() < 1e-8 * np.abs(one.roots).max()


def test_the_static_criterion_is_where_two_oblique_headings_leave_the_one_head_on():
    """Papoulias and Bernitsas (1988): ahead of N_v/Y_v a root is real and negative, behind it positive"""
    lever = yaw_stability(head_on(tanker()).lateral, SPEED, [10.0, 100.0]).lever
    assert lever == pytest.approx(SHIP.N_v / SHIP.Y_v * LENGTH, rel=1e-3)
    for share, near, positive in ((1.02, 1, False), (0.98, 3, True)):
        found = equilibria(tanker(share * lever))
        assert sum(np.cos(one.heading) > 0.5 for one in found) == near
        own = head_on(tanker(share * lever))
        assert bool(np.any((own.roots.real > 1e-9) & (np.abs(own.roots.imag) < 1e-12))) is positive
        assert bool(own.quartic[4] > 0) is not positive
    for hawser in (10.0, 300.0):  # whatever the hawser
        assert head_on(tanker(0.98 * lever, hawser)).quartic[4] < 0 < head_on(tanker(1.02 * lever, hawser)).quartic[4]


def test_a_straight_line_is_kept_where_the_loose_long_line_leaves_two_decaying_roots():
    """Abkowitz (1969); Strandhagen et al. (1950): F → 0 and ℓ → ∞ leave λ² (λ² + Aλ + S/MI)"""
    m = head_on(tanker()).lateral
    for turn in (-0.2, -1.0, -3.0):
        own = m._replace(N_r=m.N_r * -turn, pull=1e-9 * m.pull, length=1e9)
        S = straight_line(own, SPEED)
        A = -own.Y_v / own.mass - own.N_r / own.inertia
        free = np.roots([1.0, A, S / (own.mass * own.inertia)])
        found = roots(moored_quartic(own))
        assert max(np.abs(found - root).min() for root in free) < 1e-3 * np.abs(free).min()
        assert bool(S > 0) is bool(np.all(free.real < 0))


def test_where_the_hawser_changes_routh_and_hurwitz_a_pair_of_roots_crosses():
    """Wichers (1988), Sharma et al. (1988): stable on short and on very long hawsers, slewing between"""
    m = head_on(tanker()).lateral
    lengths, soft = yaw_stability(m, SPEED, np.geomspace(1.0, 3000.0, 400)).lengths, m.length - 60.0  # the lines yield
    assert len(lengths) == 2
    for length, sign in zip(lengths, (1, -1), strict=True):
        growth = [head_on(tanker(hawser=share * length - soft)).slewing.growth for share in (0.99, 1.01)]
        assert growth[0] * sign < 0 < growth[1] * sign
        pair = roots(moored_quartic(m._replace(length=length)))
        assert np.sort(np.abs(pair.real))[:2] == pytest.approx(0, abs=1e-9)
    sides = [0.99 * lengths[0], 1.01 * lengths[0], 0.99 * lengths[1], 1.01 * lengths[1]]
    assert routh_hurwitz(moored_quartic(m._replace(length=np.array(sides)))).tolist() == [True, False, False, True]


def test_a_full_tanker_does_not_keep_a_straight_line_and_one_with_twice_the_damping_does():
    for more, kept in ((1.0, False), (2.0, True)):
        m = head_on(tanker(ship=SHIP._replace(N_r=more * SHIP.N_r))).lateral
        assert bool(straight_line(m, SPEED) > 0) is kept


def test_derivatives_of_impossible_ships_are_refused():
    with pytest.raises(ValueError, match="block coefficient"):
        clarke(LENGTH, BEAM, DRAFT, 1.2)
