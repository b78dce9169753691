"""What of an imported set is compared with our own solution, and by which sizes, each limit from both sides."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.formats.judging import own_solution
from hakobune.bem.formats.judging.own_solution import Own, gaps, own_of, sample, sizes_of_forces
from hakobune.bem.formats.values import FormatError, Values, about
from hakobune.meshing.shapes import box

G = 10.0
HULL = box(8, 8, 4, panels=48)  # √A_w = 8 m


def a_set(k=(0.05, 0.15), headings=(0.0, 90.0), **more):
    """In deep water"""
    omega = np.sqrt(G * np.array(k))
    n, m = len(omega), len(headings)
    A = np.stack([np.eye(6)] * n)
    quantities = {"added_mass": A, "radiation_damping": A, "excitation_force": np.ones((n, m, 6), complex)}
    return Values(omega, np.radians(headings), np.inf, 1000.0, G, quantities, **more)


def test_waves_are_measured_by_the_waterplane_or_by_the_volume_of_what_has_none():
    assert own_solution._sizes_of_waves(a_set(), HULL) == pytest.approx([0.4, 1.2])
    lidded = SimpleNamespace(whole=lambda: SimpleNamespace(area_vectors=np.zeros((1, 3))), volume=-27.0)
    assert own_solution._sizes_of_waves(a_set(), lidded) == pytest.approx([0.15, 0.45])
    for share, size in ((1.1e-3, np.sqrt(9 * 1.1e-3)), (0.9e-3, 3.0)):
        plane = SimpleNamespace(area_vectors=np.array([[0, 0, 9 * share]]))
        thin = SimpleNamespace(whole=lambda plane=plane: plane, volume=27.0)
        assert own_solution._sizes_of_waves(a_set(), thin) == pytest.approx(size * np.array([0.05, 0.15]))


def test_sets_of_one_body_with_a_long_wave_and_few_panels_are_compared(monkeypatch):
    """k √A_w below 4; up to 2500 panels; alone"""
    assert isinstance(own_of(a_set((0.499, 9.0)), HULL), Own) and own_of(a_set((0.501, 9.0)), HULL) is None
    assert own_of(a_set(others=1), HULL) is None
    monkeypatch.setattr(own_solution, "MOST_PANELS", len(HULL))
    assert own_of(a_set(), HULL) is not None
    monkeypatch.setattr(own_solution, "MOST_PANELS", len(HULL) - 1)
    assert own_of(a_set(), HULL) is None
    monkeypatch.undo()
    lacks = a_set()
    del lacks.quantities["radiation_damping"]
    assert own_of(lacks, HULL) is None
    made = own_of(a_set(rotation_center=np.array([1.0, 2.0, 3.0])), HULL)
    assert made.center == (1.0, 2.0, 3.0) and made.nodes == 1 and made.sharper().nodes == 4
    assert made.in_water(7.0).depth == 7.0 and made.in_water(7.0) is made.in_water(7.0) and made.density == 1000.0
    assert made.arm == pytest.approx(0.5 * np.sqrt(64 + 64 + 16))


def test_a_sample_has_the_waves_nearest_to_four_tenths_and_twelve_tenths_and_five_headings():
    k = np.array([0.01, 0.03, 0.06, 0.11, 0.17, 0.3])
    values = a_set(k, np.arange(0, 360, 30.0), body={"hydrostatic_stiffness": np.eye(6), "mass": 3.0})
    values.quantities["added_mass"] = np.arange(6.0)[:, None, None] * np.eye(6)
    values.quantities["excitation_force"] = np.arange(12.0)[None, :, None] * np.ones((6, 12, 6))
    found = sample(values, HULL)
    assert found.omega == pytest.approx(np.sqrt(G * k[[2, 4]])) and found.get("added_mass")[:, 0, 0].tolist() == [2, 4]
    assert np.degrees(found.wave_direction) == pytest.approx([0, 90, 180, 240, 330])
    assert found.get("excitation_force")[0, :, 0].tolist() == [0, 3, 6, 8, 11]
    assert set(found.body) == {"hydrostatic_stiffness"}
    for sizes, place in (
        ((0.3, 1.08, 1.4), 1), ((0.3, 1.0, 1.4), 2), ((0.36, 0.467, 1.2), 0), ((0.33, 0.467, 1.2), 1),
    ):  # fmt: skip
        near = sample(a_set(np.array(sizes) / 8), HULL)  # by the ratio, of kL of 0.4 and 1.2
        assert np.sqrt(G * sizes[place] / 8) in near.omega.tolist()
        assert len(near.omega) == 2
    assert len(sample(a_set((0.07,)), HULL).omega) == 1 and len(sample(a_set(headings=()), HULL).wave_direction) == 0


class Known:
    """A solution with diagonal coefficients; yaw moves no water"""

    moves, arm = np.array([True] * 5 + [False]), 20.0
    A, B = np.diag([4.0, 4, 9, 16, 25, 0]), np.diag([0.09, 0.01, 0.64, 1.0, 4.0, 0])
    X = np.array([[3.0, 0.2, 8.0, 100.0, 5.0, 1e9], [-2.0, 0.1, 6j, 50.0, 4.0, 1e9]])

    def at(self, omega, headings):
        return self.A, self.B, self.X


def test_forces_count_by_the_largest_of_their_mode_and_no_less_than_a_tenth_of_their_kind():
    """Moments no less than the largest force at a twentieth of the arm: 8 · 1 m"""
    assert sizes_of_forces(Known.X, Known()) == pytest.approx([3, 0.8, 8, 1e8, 1e8, np.inf])
    small = Known.X.copy()
    small[:, 3:] = [[1.0, 9.0, 0.0], [2.0, 0.3, 0.0]]
    assert sizes_of_forces(small, Known()) == pytest.approx([3, 0.8, 8, 8, 9, np.inf])


@pytest.mark.parametrize("name, i, j, size", [
    ("added_mass", 2, 4, 15.0), ("radiation_damping", 0, 2, None), ("radiation_damping", 3, 4, None),
    ("added_mass", 5, 0, np.inf),
])  # fmt: skip
def test_coefficients_count_by_the_root_of_both_diagonals(name, i, j, size):
    """Of damping no less than a twentieth of ω A; of a mode that moves no water nothing"""
    omega = 0.5
    one = Values(np.array([omega]), np.zeros(2), np.inf, 1000.0, G, {
        "added_mass": Known.A[None].copy(), "radiation_damping": Known.B[None].copy(),
        "excitation_force": Known.X[None] + 0j})  # fmt: skip
    assert set(gaps(one, Known()).values()) == {0.0}
    if size is None:
        drain = np.sqrt(np.maximum(np.diag(Known.B), 0.05 * omega * np.diag(Known.A)))
        size = drain[i] * drain[j]
    one.quantities[name][0, i, j] += 0.3
    assert gaps(one, Known())[name] == pytest.approx(0.3 / size)
    one.quantities["excitation_force"][0, 1, 1] += 0.4j
    forces = {n: d for n, d in one.quantities.items() if n != "excitation_force"}
    small = Known()
    assert gaps(one, small)["excitation_force"] == pytest.approx(0.4 / 0.8)
    assert "excitation_force" not in gaps(replace(one, quantities=forces), small)


def test_values_are_moved_whichever_coordinates_differ_and_what_is_missing_says_how_to_get_it():
    """M = M′ + r × F: a surge force 2 m above the new point pitches"""
    values = a_set()
    values.quantities["excitation_force"][..., 1:] = 0.0
    moved = about(values, (0.0, 0.0, -2.0)).get("excitation_force")
    assert moved[0, 0] == pytest.approx([1, 0, 0, 0, 2.0, 0])
    assert about(values, (0.0, 0.0, 0.0)) is values
    for names, way in ((("rao",), "give it by --only"), (("rao", "inertia_matrix"), "give --gyration"),
                       (("mass", "rao"), "give --gyration and --center-of-gravity")):  # fmt: skip
        with pytest.raises(FormatError) as refused:
            values.need(*names)
        assert str(refused.value).startswith(", ".join(names) + " is not in the database; " + way)


def test_headings_of_other_conventions_are_reversed_mirrored_and_both():
    assert own_solution._images(np.array([0.3, 2.0])) == pytest.approx(
        [0.3 + np.pi, 2.0 + np.pi, -0.3, -2.0, np.pi - 0.3, np.pi - 2.0]
    )
