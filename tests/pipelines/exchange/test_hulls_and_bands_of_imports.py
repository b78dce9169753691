"""The hull of an import in its water, the band that is kept, and forces of pairs on one body of several."""

from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.meshing.hydrostatics import hydrostatics
from hakobune.meshing.panels import PanelMesh
from hakobune.pipelines.exchange import importing

LIMIT = importing.LIMITS[0] if not isinstance(importing.LIMITS, dict) else next(iter(importing.LIMITS))


@dataclass(frozen=True)
class Values:
    omega: np.ndarray
    quantities: dict
    bodies: tuple = ()


@pytest.mark.parametrize(
    "low, high, kept", [(0.3, 0.5, [1, 2]), (0.31, 9.0, [2, 3]), (0.0, 0.2, [0]), (0.0, 9.0, None)]
)
def test_a_band_keeps_its_frequencies_with_both_ends_and_the_limits(low, high, kept):
    omega = np.array([0.2, 0.3, 0.5, 0.8])
    values = Values(omega, {"added_mass": 10 * omega[:, None], "damping": omega, LIMIT: np.array([7.0])})
    found = importing.between(values, low, high)
    if kept is None:
        assert found is values
        return
    assert found.omega.tolist() == omega[kept].tolist() == found.quantities["damping"].tolist()
    assert found.quantities["added_mass"][:, 0].tolist() == (10 * omega[kept]).tolist()
    assert found.quantities[LIMIT].tolist() == [7.0]


def test_a_band_without_a_frequency_is_refused_with_those_of_the_files():
    values = Values(np.array([0.23456, 0.8]), {})
    with pytest.raises(ValueError) as refused:
        importing.between(values, 0.3, 0.5)
    assert str(refused.value) == "--frequencies 0.3:0.5 selects no frequency; the files have 0.2346 to 0.8 rad/s"


@dataclass(frozen=True)
class Forces:
    total: np.ndarray
    squares: np.ndarray = None
    bound_wave: np.ndarray = None
    body: np.ndarray = None


@pytest.mark.parametrize("bodies, number, own", [(("a", "b"), 1, range(12)), ((), 1, range(6, 12)), ((), 0, range(6))])
def test_forces_of_pairs_are_those_of_all_bodies_or_of_one(monkeypatch, bodies, number, own):
    asked = []
    monkeypatch.setattr(importing, "body_of", lambda *given: asked.append(given) or number)
    columns = np.arange(12.0)[None]
    forces = Forces(columns, columns, 10 * columns, 100 * columns)
    found = importing._of_bodies(forces, "place", Values(None, {}, bodies), "known")
    assert found.squares[0].tolist() == [*map(float, own)]
    assert found.bound_wave[0].tolist() == [10.0 * i for i in own] and found.body[0, 0] == 100.0 * own[0]
    assert asked == ([] if bodies else [("place", 2, "known")]) and (found is forces) == bool(bodies)


def test_pairs_are_read_beside_files_of_wamit_alone(monkeypatch):
    from hakobune.bem.formats import wamit_pairs

    asked = []
    monkeypatch.setattr(wamit_pairs, "SUFFIXES", ("one", "two"))
    monkeypatch.setattr(
        wamit_pairs, "read_pairs", lambda *given: asked.append(given) or (None if given[2] == "one" else 5)
    )
    monkeypatch.setattr(importing, "_of_bodies", lambda *given: given)
    values = SimpleNamespace(density=1000.0, gravity=9.8)
    known = {"length_unit": 2.0}
    assert importing.pairs_of("place", "wamit", values, known) == [(5, "place", values, known)]
    assert asked == [("place", 9800.0, "one", 2.0), ("place", 9800.0, "two", 2.0)]
    assert importing.pairs_of("place", "nemoh", values, known) == [] and len(asked) == 2


@dataclass(frozen=True)
class Panels:
    moves: tuple = ()
    wet: bool = False

    def moved(self, *by):
        return replace(self, moves=(*self.moves, by))


@pytest.fixture
def hulls(monkeypatch):
    monkeypatch.setattr(importing, "read_mesh", lambda path: Panels())
    monkeypatch.setattr(importing, "wetted", lambda mesh: replace(mesh, wet=True))
    monkeypatch.setattr(importing, "findings", lambda mesh: [
        Told("error", "open"), Told("warning", "coarse"),
    ])  # fmt: skip


@dataclass(frozen=True)
class Told:
    severity: str
    text: str

    def __str__(self):
        return f"{self.severity}: {self.text}"


@pytest.mark.parametrize("drawn, origin, moves, wet", [
    (None, None, (), False), ((1.0, 2.0, 0.0), None, ((1.0, 2.0, 0.0),), False),
    (None, (0.0, 0.0, 0.0), (), False), (None, (0.0, 0.0, -3.0), ((0.0, 0.0, -3.0),), True),
    ((1.0, 2.0, 0.0), (0.0, 0.0, -3.0), ((1.0, 2.0, 0.0), (0.0, 0.0, -3.0)), True),
])  # fmt: skip
def test_a_hull_of_the_files_is_moved_to_its_place_and_the_height_of_its_axes(hulls, tmp_path, capsys, drawn, origin,
                                                                            moves, wet):  # fmt: skip
    mesh = tmp_path / "hull.gdf"
    mesh.write_text("")
    module = SimpleNamespace(hull_of=lambda place, known: mesh if place == "place" else None)
    if drawn:
        module.drawn_at = lambda place, known: drawn
    known = {"rotation_center": origin}
    found = importing.hull_of("place", "kind", module, None, known)
    assert (found.moves, found.wet) == (moves, wet)
    assert capsys.readouterr().err == f"{mesh}: warning: coarse\n"
    given = importing.hull_of("place", "kind", module, mesh, known)  # a mesh of one's own stays where it is
    assert (given.moves, given.wet) == ((), False)


def test_a_hull_that_is_missing_is_told_with_the_file_that_would_have_it(hulls, tmp_path):
    begins = "the hull is missing; give --mesh FILE"
    ends = ", where FILE is a file of panels, or a .toml that builds the hull of parts"
    with pytest.raises(ValueError) as refused:
        importing.hull_of("place", "kind", SimpleNamespace(), None, {})
    assert str(refused.value) == begins + ends
    path = tmp_path / "none.gdf"
    with pytest.raises(ValueError) as refused:
        importing.hull_of("place", "kind", SimpleNamespace(hull_of=lambda *_: path), None, {})
    assert str(refused.value) == f"{begins} ({path} does not exist){ends}"
    (tmp_path / "other_pan.dat").write_text("")
    for name, near in (("set.1", ""), ("other.1", f" ({tmp_path / 'other_pan.dat'}, beside the files)")):
        with pytest.raises(ValueError) as refused:
            importing.hull_of(tmp_path / name, "kind", SimpleNamespace(), None, {})
        assert str(refused.value) == f"{begins}{near}{ends}"


@pytest.mark.parametrize("above, left", [(0.0, 6), (0.04, 5), (3.0, 5)])
def test_what_lies_above_the_water_is_no_hull(above, left, capsys):
    """A box of 10 × 4 × 5 m with sides from the water and a lid above it"""
    x, y = np.array([-5.0, 5, 5, -5]), np.array([-2.0, -2, 2, 2])
    rings = [np.column_stack([x, y, np.full(4, z)]) for z in (-5.0, 0.0, above)]
    sides = [[i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i] for i in range(4)]
    mesh = PanelMesh(np.vstack(rings), np.array([*sides, [3, 2, 1, 0], [8, 9, 10, 11]]), name="a box")
    made = importing.below_water(mesh)
    assert len(made) == left and made.points[:, 2].max() == 0.0
    said = capsys.readouterr().err
    assert (f"a box: 1 panels up to {above:.3g} m above the water are left out" in said) == (left == 5)
    with pytest.raises(ValueError, match="the hull has no part below z = 0; its lowest point is at 1 m"):
        importing.below_water(mesh.moved(dz=6.0))


def test_walls_that_cross_the_surface_are_cut_there():
    """A closed box of 5 m draft and 3 m freeboard floats on 10 × 4 × 5 m and has its waterplane of 40 m²"""
    x, y = np.array([-5.0, 5, 5, -5]), np.array([-2.0, -2, 2, 2])
    rings = [np.column_stack([x, y, np.full(4, z)]) for z in (-5.0, 3.0)]
    sides = [[i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i] for i in range(4)]
    made = importing.below_water(PanelMesh(np.vstack(rings), np.array([*sides, [3, 2, 1, 0], [4, 5, 6, 7]])))
    still = hydrostatics(made, center_of_mass=np.zeros(3), density=1000.0, gravity=10.0)
    assert still.volume == pytest.approx(200.0) and still.stiffness[2, 2] == pytest.approx(4e5)
