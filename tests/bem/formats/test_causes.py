"""Each single change of unit, sign, point or convention is named, and corrected to the set as it was.

The solution of the hull is a stand-in: numbers without symmetry, whose forces are a few harmonics of the heading.
"""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.formats.judging.causes import FORCES, MATRICES, changed, corrected, finding, of_length, turned
from hakobune.bem.formats.judging.own_solution import Own, gaps
from hakobune.bem.formats.values import FormatError, Values, about
from hakobune.bem.kernels.progress import OWN, progress_callback
from hakobune.bem.modes import reference_change
from hakobune.bem.waves import wavenumber
from hakobune.meshing.shapes import box

RHO, G, DEPTH = 1025.0, 9.80665, 30.0
OMEGA, BETA = np.array([0.5, 0.9]), np.radians([0.0, 40.0, 100.0, 160.0])
random = np.random.default_rng(7)
HALF = random.normal(size=(2, 6, 6))
SIZE = np.array([1, 1, 1, 6, 6, 6.0])
A0 = (HALF + HALF.swapaxes(1, 2) + 8 * np.eye(6)) * np.outer(SIZE, SIZE) * 1e5
B0 = (np.einsum("nij,nkj->nik", HALF, HALF) + np.eye(6)) * np.outer(SIZE, SIZE) * 3e4
HARMONICS = (random.normal(size=(2, 5, 6)) + 1j * random.normal(size=(2, 5, 6))) * SIZE * 1e5


@pytest.mark.parametrize("nodes", [1, 4])
def test_each_solution_to_compare_with_is_announced_once(nodes):
    """Panels, nodes and frequency of what is solved, before it is; what is known already is not solved again"""
    said, own = [], Own(box(4.0, 2.0, 1.0, counts=(2, 2, 1)), DEPTH, RHO, G, nodes=nodes)
    with progress_callback(lambda stage, what: said.append((stage, what))):
        for omega in (0.5, 0.9, 0.5):
            own.at(omega, [0.0])
    assert [stage for stage, _ in said] == [OWN, OWN] and [omega for _, (_, omega) in said] == [0.5, 0.9]
    assert all(prepared.problem.nodes_per_panel == nodes for _, (prepared, _) in said)


class Hull:
    """Stands in for `Own`, in deep water too, and with more nodes"""

    moves, arm, draft, center = np.ones(6, bool), 20.0, 5.0, (0.0, 0.0, 0.0)

    def at(self, omega, headings):
        n = int(np.argmin(np.abs(OMEGA - omega)))
        off = omega / OMEGA[n]  # another frequency has other numbers
        b = np.asarray(headings)
        shapes = np.stack([np.ones_like(b), np.cos(b), np.sin(b), np.cos(2 * b), np.sin(2 * b)], axis=1)
        return A0[n] * off, B0[n] * off**3, shapes @ HARMONICS[n] * off

    def in_water(self, depth):
        return self

    def sharper(self):
        return self


def right():
    parts = [Hull().at(w, BETA) for w in OMEGA]
    A, B, X = (np.array(part) for part in zip(*parts, strict=True))
    quantities = {"added_mass": A, "radiation_damping": B, "excitation_force": X}
    return Values(OMEGA, BETA, DEPTH, RHO, G, quantities)


def by(names, factor):
    return lambda one: changed(one, names, lambda data: data * factor)


def moved(names, r):
    T = reference_change(r)
    return lambda one: changed(one, names, lambda d: d @ T.T if np.iscomplexobj(d) else T @ d @ T.T)


def axes(signs, words):
    S = np.array(signs, float)
    return lambda one: turned(
        changed(one, FORCES + MATRICES, lambda d: d * S if np.iscomplexobj(d) else d * np.outer(S, S)), words
    )


def crest_at(x, y):
    def change(one):
        k = wavenumber(one.omega, DEPTH, G)[:, None]
        turn = np.exp(-1j * k * (x * np.cos(one.wave_direction) + y * np.sin(one.wave_direction)))
        return changed(one, FORCES, lambda X: X * turn[..., None])

    return change


CHANGES = {
    "dimensionless by a length of 10 m": lambda one: of_length(one, 10.0),
    "dimensionless by a length of 47 m": lambda one: of_length(one, 47.0),
    "forces are 1000 times as large: kilo": by(FORCES, 1e3),
    "forces are 2 times as large: per metre of wave height": by(FORCES, 2.0),
    "added mass are 0.001 times as large": by(("added_mass",), 1e-3),
    "damping are -1 times as large: the opposite sign": by(("radiation_damping",), -1.0),
    "added mass, damping and forces are 0.001": by((*MATRICES, *FORCES), 1e-3),
    "moments are 0.01745 times as large: per degree": by(FORCES, np.where(SIZE > 1, np.pi / 180, 1.0)),
    "damping is that over ω": lambda one: changed(one, MATRICES[1:2], lambda B: B / one.omega[:, None, None]),
    "phases are the conjugates of ours": lambda one: changed(one, FORCES, np.conj),
    "forces are -1 times as large: the opposite sign": by(FORCES, -1.0),
    "phases are 90° ahead of ours": by(FORCES, 1j),
    "headings are the directions that waves come from": lambda one: turned(one, "opposite"),
    "headings are counted clockwise": lambda one: turned(one, "mirrored"),
    "compass directions (clockwise) that waves come from": lambda one: turned(one, "opposite mirrored"),
    "axes have z down and y to starboard": axes((1, -1, -1, 1, -1, -1), "mirrored"),
    "axes have x aft and y to starboard": axes((-1, -1, 1, -1, -1, 1), "opposite"),
    "pitch has the opposite sign": axes((1, 1, 1, 1, -1, 1), ""),
    "moments and rotations are about (5, 1, -3) m": moved(FORCES + MATRICES, (5.0, 1.0, -3.0)),
    "moments of the wave forces, but not those of added mass, are about (0, 0, -4) m": moved(FORCES, (0, 0, -4.0)),
    "rotations of added mass and damping, but not moments": moved(MATRICES, (2.0, 0, -4.0)),
    "phase 0 is a crest at (6, -2) m": crest_at(6.0, -2.0),
    "frequencies are in Hz": lambda one: replace(one, omega=one.omega / (2 * np.pi)),
}


def test_a_set_as_it_is_has_no_finding():
    assert finding(right(), Hull()) is None
    within = changed(right(), FORCES, lambda X: 1.08 * X)
    assert finding(within, Hull()) is None and gaps(within, Hull())["excitation_force"] == pytest.approx(0.08)


@pytest.mark.parametrize("words", CHANGES)
def test_a_single_change_is_named_and_corrected(words):
    found = finding(CHANGES[words](right()), Hull())
    assert found.gap > 0.1 and words in found.cause.text
    again = corrected(CHANGES[words](right()), found.cause)
    for name, data in right().quantities.items():
        assert again.quantities[name] == pytest.approx(data, rel=1e-6, abs=1e-6 * np.abs(data).max())
    assert np.exp(1j * again.wave_direction) == pytest.approx(np.exp(1j * BETA))
    assert again.omega == pytest.approx(OMEGA)


@pytest.mark.parametrize("one, two", [
    ("forces are 1000 times as large: kilo", "moments and rotations are about (5, 1, -3) m"),
    ("damping are -1 times as large: the opposite sign", "phases are the conjugates of ours"),
])  # fmt: skip
def test_two_changes_are_named_both_and_corrected(one, two):
    wrong = CHANGES[two](CHANGES[one](right()))
    found = finding(wrong, Hull())
    assert "two causes" in found.cause.text and one in found.cause.text and two in found.cause.text
    again = corrected(wrong, found.cause)
    for name, data in right().quantities.items():
        assert again.quantities[name] == pytest.approx(data, rel=1e-6, abs=1e-6 * np.abs(data).max())


def test_what_no_single_change_explains_has_no_cause():
    noise = np.random.default_rng(1).normal(size=(2, 4, 6))
    spoilt = changed(right(), FORCES, lambda X: X * (1 + noise))
    found = finding(spoilt, Hull())
    assert found.cause is None and found.quantity == "excitation_force"


def test_a_set_without_forces_is_held_against_its_hull_by_its_coefficients():
    own = Own(box(8, 8, 4, panels=48), DEPTH, RHO, G)
    A, B, X = own.at(0.9, np.zeros(0))
    assert X.shape == (0, 6) and A[2, 2] > 0
    alone = Values(np.array([0.9]), np.zeros(0), DEPTH, RHO, G, {"added_mass": A[None], "radiation_damping": B[None]})
    assert finding(alone, own) is None
    found = finding(changed(alone, MATRICES, lambda M: 1e3 * M), own)
    assert "added mass and damping are 1000 times as large" in found.cause.text


@pytest.mark.parametrize("given", [14.0, 40.0, np.inf])
def test_a_wrong_depth_is_named_and_not_taken_for_a_factor(given):
    """A set of 25 m of water said to be of another depth; in the right depth there is nothing to say"""
    hull, omega, beta = box(40, 16, 4, panels=60), np.array([0.35, 0.7]), np.radians([0.0, 45.0, 90.0])
    A, B, X = (np.array(part) for part in zip(*(Own(hull, 25.0, RHO, G).at(w, beta) for w in omega), strict=True))
    quantities = {"added_mass": A, "radiation_damping": B, "excitation_force": X}
    found = finding(Values(omega, beta, given, RHO, G, quantities), Own(hull, given, RHO, G))
    depth = float(found.cause.text.split("about ")[1].split(" m,")[0])
    assert depth == pytest.approx(25.0, rel=0.03) and found.cause.fitted and "--depth" in found.cause.way_out
    assert found.left < 0.1 < found.gap
    assert finding(Values(omega, beta, 25.0, RHO, G, quantities), Own(hull, 25.0, RHO, G)) is None


def test_motions_that_follow_from_what_is_wrong_are_left_out():
    wrong = changed(right(), FORCES, np.conj)
    wrong = replace(wrong, quantities=wrong.quantities | {"rao": wrong.get("excitation_force")})
    assert "rao" not in corrected(wrong, finding(wrong, Hull()).cause).quantities


def test_the_point_of_moments_follows_from_forces_by_least_squares():
    """M about p is M − p × F, as `about` has it"""
    from hakobune.bem.formats.judging.causes import point_of_moments

    one = right()
    X = one.get("excitation_force")
    other = about(one, (3.0, -1.0, 2.0)).get("excitation_force")
    assert point_of_moments(other, X) == pytest.approx((3.0, -1.0, 2.0))


def test_an_import_refuses_what_a_cause_explains_and_stores_it_corrected_if_asked(monkeypatch):
    from hakobune.bem.formats.judging import believed

    wrong = changed(right(), FORCES, np.conj)
    for name, made in (("own_of", lambda values, mesh: Hull()), ("sample", lambda values, mesh: values)):
        monkeypatch.setattr(believed, name, made)
    monkeypatch.setattr(believed.laws, "doubts", lambda values: (["a law"], ["laws"]))
    with pytest.raises(FormatError, match=r"our own solution .*: phases are the conjugates .*; import with --correct"):
        believed.believed(wrong, ())
    values, told, doubts = believed.believed(wrong, (), correct=True)
    assert values.get("excitation_force") == pytest.approx(right().get("excitation_force"))
    assert "corrected: phases are the conjugates" in told[0] and doubts == []
    assert believed.believed(right(), ())[1:] == ([], ["a law"])
    monkeypatch.setattr(believed, "own_of", lambda values, mesh: None)
    _, told, _ = believed.believed(right(), ())
    assert (
        "the files are not compared with our own solution: no frequency belongs to a long wave; laws tested: laws"
        in told[0]
    )


@pytest.mark.parametrize(
    ("ratio", "factor"), [(2.058, 2.0), (2.062, 2.062), (-0.972, -1.0), (970.5, 1e3), (0.969, 0.969)]
)
def test_a_factor_within_three_per_cent_of_a_known_one_is_that(ratio, factor):
    """By least squares in sizes of rows"""
    from hakobune.bem.formats.judging.causes import _factor

    own = np.array([[1.0, 2.0], [3j, 4.0]])
    assert _factor([(ratio * own, own, np.array([[1.0, 10.0], [2.0, 3.0]]))]) == pytest.approx(factor)
