"""Axes of the result of a mooring: motions, lines, loads, contacts and hinges by their names, of one body and several;
and how many directions waves of a body need."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.moor import result
from hakobune.pipelines.results.quantity import Quantity
from hakobune.pipelines.solve import header

SIZES = {"mode": 2, "line": 2, "load": 3, "motion": 6, "force": 6, "plane": 3, "xyz": 3, "body": 1, "contact": 2}
SIZES |= {"hinge": 6}
ONE = ("mode", "line", "load", "motion", "force", "plane", "xyz", "contact")


@pytest.fixture
def made(monkeypatch):
    def call(bodies=(), axes=ONE, anchors=("a", None)):
        count = max(1, sum(not one.fixed for one in bodies))
        many = {"load", "force", "plane"} if bodies else set()
        sizes = SIZES | {"motion": 6 * count, "body": count} | {axis: SIZES[axis] * count for axis in many}
        quantities = {axis.upper(): Quantity(np.zeros(sizes[axis]), (axis,), "", "") for axis in axes}
        pieces = iter(quantities.items())
        asked = []
        for name in ("_steady", "_periods", "_lines", "_held", "_waves"):
            piece = dict([next(pieces)])
            monkeypatch.setattr(result, name, lambda made, shapes=(), piece=piece: piece)
        rest = dict(pieces)
        monkeypatch.setattr(result, "_place", lambda made: rest)
        monkeypatch.setattr(result, "quantities_of_anchors", lambda *of: asked.append(of) or {})
        monkeypatch.setattr(result, "provenance", lambda *of: {"of": str(of)})
        monkeypatch.setattr(result, "notes", lambda made: ["note"])
        monkeypatch.setattr(result, "resonant", lambda made, of: ["resonance"] if of is db else 0)
        reader = SimpleNamespace(names=("Surge", "Sway", "Yaw"), words=("surge", "sway", "yaw"))
        if "motion" in axes:
            reader = SimpleNamespace(names=("Surge", "Sway", *"abcd", *"efghij"[: 6 * (count - 1)]),
                                     words=("surge", "sway", *"ABCD", *"EFGHIJ"[: 6 * (count - 1)]))  # fmt: skip
        db = SimpleNamespace(bodies=bodies, bodies_reader=reader, modes=())
        found = SimpleNamespace(
            at_rest=SimpleNamespace(names=("Sway", "Surge")), system=SimpleNamespace(line_names=("bow", "stern")),
            loads=("wind", "waves"), berth=SimpleNamespace(names=("F", "R")), hinges=("pin",), bent=None,
            warnings=("FAILS: it", "first"), extreme=SimpleNamespace(horizontal_a="along", vertical_a=np.array([-2.0])),
        )  # fmt: skip
        return result.result_of(found, "hull", "text", db, ("first",), anchors), asked

    return call


def labels(result, axis):
    return [str(one) for one in result.labels[axis].values]


def test_axes_of_one_body_have_the_words_of_its_motions_and_names_of_its_parts(made):
    found, asked = made()
    assert labels(found, "mode") == ["sway", "surge"] and labels(found, "line") == ["bow", "stern"]
    assert labels(found, "load") == ["wind", "waves", "sum"] and labels(found, "motion")[:2] == ["surge", "sway"]
    assert labels(found, "force") == list(result.FORCES) and labels(found, "plane") == ["x", "y", "yaw"]
    assert labels(found, "xyz") == ["x", "y", "z"] and labels(found, "contact") == ["F", "R"]
    assert "hinge" not in found.labels and "body" not in found.labels  # nothing is on these
    ((anchors, along, up),) = asked
    assert (anchors, along, up.tolist()) == (("a", None), "along", [2.0]) and found.kind == "moor"
    assert (found.findings, found.first, found.notes) == (("FAILS: it",), ("first",), ("note", "resonance"))
    assert found.detail[1] == "hull" and "text" in found.provenance["of"]


def test_hinges_carry_three_forces_and_three_moments(made):
    found, _ = made(axes=("hinge", "line", "mode", "xyz", "contact"))
    assert labels(found, "hinge") == [
        "pin force x", "pin force y", "pin force z", "pin moment x", "pin moment y", "pin moment z",
    ]  # fmt: skip


def test_loads_and_forces_of_several_are_of_each_that_moves(made):
    bodies = [SimpleNamespace(name="ship", fixed=False), SimpleNamespace(name="pier", fixed=True),
              SimpleNamespace(name="barge", fixed=False)]  # fmt: skip
    found, _ = made(bodies, ("load", "force", "plane", "body", "line"))
    assert labels(found, "body") == ["ship", "barge"]
    for axis, parts in (
        ("load", ["wind", "waves", "sum"]),
        ("plane", ["x", "y", "yaw"]),
        ("force", list(result.FORCES)),
    ):
        own = labels(found, axis)
        assert len(own) == 2 * len(parts)
        assert all(name in one and part in one for one, (name, part) in zip(
            own, ((name, part) for name in ("ship", "barge") for part in parts), strict=True))  # fmt: skip


@pytest.mark.parametrize("count, kept", [(4, None), (500, 500)])
def test_directions_of_waves_resolve_the_shortest_at_the_farthest_point(monkeypatch, count, kept):
    """(30, 40) m is 50 m away"""
    asked = []
    monkeypatch.setattr(header, "angles", lambda k, radius: asked.append((k, radius)) or np.zeros(count))
    mesh = SimpleNamespace(points=np.array([[30.0, -40.0, -99.0], [1.0, 2.0, 0.0]]))
    found = header.kochin_angles("scene", mesh, 12.0)
    kept = header.FEWEST_ANGLES if kept is None else kept
    assert len(found) == kept and found == pytest.approx(2 * math.pi * np.arange(kept) / kept)
    assert asked == [(pytest.approx(2 * math.pi / 12.0), pytest.approx(50.0))]
