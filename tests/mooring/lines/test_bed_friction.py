"""Work that friction of the bed takes from a moving line, against closed forms and its own refinement."""

import numpy as np
import pytest

from hakobune.mooring.lines.dynamics.simulation import DynamicLine, DynamicSegment, ElasticBed, FairleadMotion, simulate

WEIGHT, EA, MASS, FRICTION = 979.3, 4.933e8, 114.94, 0.5


def chain(elements, span, depth):
    drag = dict(drag_normal=1.333, drag_tangential=0.2034, added_tangential=0.5)
    segment = DynamicSegment(300.0, MASS, WEIGHT, 0.1368, EA, elements, **drag)
    return DynamicLine(segment, (-span, 0.0, -depth), bed=ElasticBed(friction=FRICTION))


def last_cycle(line, amplitude, period, cycles, **options):
    """J, work against friction in the last of some cycles of surge"""
    motion = FairleadMotion.harmonic((0, 0, 0), (1j * amplitude, 0, 0), period)
    begin = (cycles - 1) * period
    run = simulate(line, motion, cycles * period, check_mesh=False, stops=[begin], **options)
    return run.energies.friction[-1] - np.interp(begin, run.time, run.energies.friction)


@pytest.mark.parametrize("amplitude", [0.0025, 0.01])
def test_a_bar_on_a_bed_that_is_pulled_to_and_fro_slips_as_far_as_friction_lets_its_pull_go(amplitude):
    """With friction f a metre a change of pull p slips p/f of the bar and moves its end by p²/2EAf, turned back by
    p²/4EAf: a cycle of ±A takes pulls of a range R with 2A = R²/4EAf, and the work R³/12EAf."""
    f = FRICTION * WEIGHT
    pull = np.sqrt(8 * amplitude * EA * f)
    assert pull / (2 * f) < 150.0
    lost = last_cycle(chain(120, 300.0 * (1 + 5e5 / EA), 0.0), amplitude, 40.0, 3)
    assert abs(lost / (pull**3 / (12 * EA * f)) - 1) < 0.02


@pytest.mark.parametrize(("amplitude", "period"), [(0.5, 7.0), (1.0, 14.0), (0.7, 20.0), (0.5, 25.0)])
def test_work_of_friction_is_known_where_a_thousand_times_as_much_goes_into_the_water(amplitude, period):
    line = chain(40, 290.0, 50.0)
    ours, fine = (last_cycle(line, amplitude, period, 4, tolerance=t) for t in (1e-3, 1e-5))
    assert abs(ours / fine - 1) < 0.02
