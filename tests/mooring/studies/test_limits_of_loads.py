"""Limits of loads on lines: on one side of each a line is told of with its number, on the other it is not."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.studies.overloads import overloads


def state(used, strain=0.0, tension=1e5):
    """Equilibrium of two lines, of which one uses that share of its breaking load and stretches by that strain"""
    kind = SimpleNamespace(axial_stiffness=tension / strain if strain else np.inf)
    lines = tuple(SimpleNamespace(name=name, type=kind) for name in ("A", "B"))
    system = SimpleNamespace(line_names=("A", "B"), lines=lines, hawsers=())
    both = SimpleNamespace(utilisation=np.array([used, 0.2]))
    return SimpleNamespace(system=system, tension=np.array([tension, 0.0]), lines=both)


@pytest.mark.parametrize("used, told", [(0.99, False), (1.0, False), (1.01, True), (1.3, True), (np.nan, False)])
def test_a_line_parts_at_its_breaking_load_and_not_before(used, told):
    """At rest, held at an offset and with another line lost: 100 % is the load at which it parts, by definition"""
    one, sound = state(used), state(0.5)
    curve = SimpleNamespace(
        offset=np.array([-5.0, 5.0]), direction=np.pi / 2, tension=np.ones((2, 2)), missed={},
        utilisation=np.array([[0.3, 0.2], [used, 0.1]]), body="barge",
    )  # fmt: skip
    wanted = f"A {100 * used:.4g} %; limit 100 %"
    for where, said in (
        ("at rest", list(overloads(one))),
        ("with the body held at offsets up to 5 m along 90°", list(overloads(sound, [curve]))),
        ("after the loss of B", list(overloads(sound, losses={"B": one}))),
    ):
        assert len(said) == told, (where, said)
        assert not told or (said[0].startswith(f"FAILS: {where}") and wanted in said[0])
    (lost,) = overloads(sound, losses={"B": ValueError("it does not reach")})
    assert lost == "FAILS: after the loss of B there is no equilibrium: it does not reach"


@pytest.mark.parametrize("strain, told", [(0.49, False), (0.51, True)])
def test_a_rope_parts_at_half_as_much_length_again(strain, told):
    said = list(overloads(state(0.5, strain)))
    assert len(said) == told and (not told or f"A {100 * strain:.4g} %; limit 50 %" in said[0])
