"""Estimated errors of forces of wave pairs on two bodies: each over the larger of its own surge and sway, of sums over
the largest of its own forces and moments."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.second_order.kinds import SUM
from hakobune.pipelines.qtf import report

MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
WORDS = [f"{body} {motion}" for body in ("ship", "barge") for motion in MOTIONS]


def stored(force, error, **more):
    """Two pairs of waves of two headings, whose mixed headings do not count: of sizes 3/5 and √(41)/5 their root mean
    square is 1"""
    share = np.array([3.0, math.sqrt(41.0)]) / 5.0

    def part(sizes):
        made = np.full((1, 2, 2, 2, 12), 99.0 + 0j)
        for heading in (0, 1):
            made[0, :, heading, heading, :] = share[:, None] * np.asarray(sizes) * 1j
        return made

    forces = SimpleNamespace(total=part(force), headings=np.array([0.0, 1.0]), kind=SUM, surface=None, frequency=[1.0])
    return SimpleNamespace(forces=forces, errors=part(error), words=WORDS, names=WORDS, method="panel", **more)


FORCE = [4e3, 2e3, 1e3, 5e3, 6e3, 8e3, 1e3, 5e3, 9e3, 2e3, 3e3, 4e3]
ERROR = [40.0, 60.0, 10.0, 50.0, 60.0, 160.0, 30.0, 50.0, 90.0, 20.0, 30.0, 20.0]


def test_errors_of_differences_are_of_the_larger_of_surge_and_sway_and_of_yaw_itself():
    assert report._relative(stored(FORCE, ERROR)) == (
        "ship surge 1 %, ship sway 1.5 %, ship yaw 2 %, barge surge 0.6 %, barge sway 1 %, barge yaw 0.5 %"
    )


@pytest.mark.parametrize("share, told", [(1.1e-6, True), (0.9e-6, False)])
def test_a_force_of_a_millionth_is_rounding_and_has_no_error(share, told):
    """A body in waves along its axis has no sway"""
    force = FORCE.copy()
    force[1] = share * force[0]
    assert ("ship sway 1.5 %" in report._relative(stored(force, ERROR))) is told


def test_errors_of_sums_are_of_the_largest_force_and_the_largest_moment_of_their_body():
    """Forces 4 kN of the ship and 9 of the barge, moments 8 and 4 kN m"""
    first, second = report._of_sums(stored(FORCE, ERROR))
    ship = "ship surge 1 %, ship sway 1.5 %, ship heave 0.25 %, ship roll 0.625 %, ship pitch 0.75 %, ship yaw 2 %"
    barge = "barge surge 0.333 %, barge sway 0.556 %, barge heave 1 %, barge roll 0.5 %, "
    barge += "barge pitch 0.75 %, barge yaw 0.5 %"
    assert first == f"estimated error of the panels, of the largest force and moment: {ship}, {barge}"
    assert second.startswith("left out: the free-surface forcing around the body, a large part of sum-frequency")
    few = ERROR.copy()
    few[3] = 0.9e-6 * 8e3  # a millionth of the largest moment
    assert "ship roll" not in next(iter(report._of_sums(stored(FORCE, few))))
    few[3] = 1.1e-6 * 8e3
    assert "ship roll 0.00011 %" in next(iter(report._of_sums(stored(FORCE, few))))
