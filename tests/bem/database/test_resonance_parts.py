"""Parts of the search for resonances, each by hand."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import eigh

from hakobune.bem.database.resonances import (
    _places,
    about,
    by_motion,
    natural_modes,
    positive,
    resonances,
    zeros,
)
from hakobune.bem.viscous import Quadratic, Viscous


def test_natural_modes_are_those_of_the_generalised_eigenvalue_problem():
    rng = np.random.default_rng(1)
    M, C = (a @ a.T + np.eye(6) for a in rng.normal(size=(2, 6, 6)))
    values, vectors = natural_modes(np.stack([M, 2 * M]), C)
    exact = eigh(C, M, eigvals_only=True)
    assert values[0] == pytest.approx(exact) and values[1] == pytest.approx(exact / 2)
    for one in vectors[0].T:
        left = C @ one
        assert left == pytest.approx((one @ C @ one) * (M @ one), abs=1e-9)
        assert one @ M @ one == pytest.approx(1.0)


def test_modes_are_called_by_the_motions_that_together_carry_most_of_their_energy():
    """Not each by its largest: the first two both have most in surge, and one has to be sway"""
    energies = np.eye(6)[[0, 0, 4, 2, 3, 5]] * 10.0
    energies[0, 1], energies[1, 1] = 8.0, 1.0
    assert by_motion(energies).tolist() == [1, 0, 3, 4, 2, 5]
    energies[2] *= 100  # shares count, whatever a mode is scaled by
    assert by_motion(energies).tolist() == [1, 0, 3, 4, 2, 5]


def test_zeros_of_several_functions_are_found_at_once():
    roots = np.array([0.3, 0.5, 2.0])

    def functions(x):
        return np.array([x[0] ** 3 - 0.027, np.exp(x[1]) - np.exp(0.5), 4 - x[2] ** 2])

    low, high = np.array([0.1, 0.0, 1.0]), np.array([1.0, 3.0, 2.5])
    assert zeros(functions, low, functions(low), high, functions(high)) == pytest.approx(roots, rel=1e-11)


def test_places_show_a_peak_at_shares_of_its_width_up_to_three_tenths_of_its_frequency():
    """ω (1 ± ζ/8, ζ/4 … 128 ζ)"""
    found = _places(2.0, 0.001) / 2.0 - 1
    away = 0.001 * 2.0 ** np.arange(-3, 8)
    assert found == pytest.approx(np.concatenate([-away[::-1], [0], away]))
    wide = _places(2.0, 0.02) / 2.0 - 1
    assert wide.min() == pytest.approx(-0.3) and wide.max() == pytest.approx(0.3) and len(wide) == 2 * 8 + 1
    body = SimpleNamespace(between=SimpleNamespace(span=(1.9, 2.1)))
    peaks = [SimpleNamespace(omega=2.0, damping=0.001)]
    inside = about(body, peaks)
    assert inside == pytest.approx(2 * (1 + found[np.abs(found) < 0.05])) and len(inside) == 2 * 9 + 1


@pytest.mark.parametrize("apart", [1e-16, 3e-15, 1e-9])
def test_two_peaks_at_one_frequency_but_for_rounding_are_shown_once(apart):
    """Roll and pitch of a round body: steps below a thousandth of a width show nothing, and no spline goes through"""
    body = SimpleNamespace(between=SimpleNamespace(span=(1.9, 2.1)))
    peaks = [SimpleNamespace(omega=2.0 * (1 + k * apart), damping=0.001) for k in range(2)]
    once = about(body, peaks[:1])
    both = about(body, peaks)
    assert len(both) == len(once) and np.diff(both).min() > 1e-4
    assert about(body, peaks, 2.0 * (1 + np.array([-1e-15, 0.05]))) == pytest.approx(once[once != 2.0])
    far = [peaks[0], SimpleNamespace(omega=2.0002, damping=0.001)]
    assert len(about(body, far)) > 1.5 * len(once)


class OneMotion:
    """A body that answers in heave alone, of constant added mass and damping, excited by 1 N/m"""

    omega, headings, viscous = np.linspace(0.5, 2.0, 16), np.array([0.0]), None
    words, free = ("surge", "sway", "heave", "roll", "pitch", "yaw"), None
    turning = np.arange(6) > 2
    inertia, stiffness = np.diag([1.0] * 6), np.diag([0, 0, 2.0, 0, 0, 0])  # M + A = 2: resonance at 1 rad/s

    def __init__(self, zeta, force=1.0, other=0.0):
        self.zeta, self.force, self.other = zeta, force, other
        self.damping = np.zeros((6, 6))
        self.between = SimpleNamespace(span=(0.5, 2.0))

    def held_added_mass(self, omega):
        return np.tile(np.eye(6), (len(omega), 1, 1))

    def coefficients(self, omega):
        B = np.zeros((len(omega), 6, 6))
        B[:, 2, 2] = 4 * self.zeta  # 2ζ ω (M + A)
        return self.held_added_mass(omega), B

    def motions(self, omega):
        omega = np.asarray(omega)
        X = np.zeros((len(omega), 1, 6), complex)
        X[:, 0, 2] = self.force / (2 - 2 * omega**2 - 4j * self.zeta * omega)
        X[:, 0, 0] = self.other
        return X

    def at(self, omega, name):
        return self.motions(omega), 0.1 * np.abs(self.motions(omega))


def test_a_peak_has_the_height_of_force_over_damping():
    (found,) = resonances(OneMotion(0.05))
    assert found.mode == 2 and found.damping == pytest.approx(0.05) and not found.viscous
    highest = 1 / (4 * 0.05 * np.sqrt(1 - 0.05**2))
    assert found.peak == pytest.approx(highest, rel=1e-3) and found.omega == pytest.approx(1.0, rel=5e-3)
    assert found.error == pytest.approx(0.1 * found.peak) and found.period == pytest.approx(2 * np.pi / found.omega)


def test_damping_of_its_own_motion_beside_that_of_waves_is_told():
    """Of a diagonal: what damps heave counts for the peak of heave, what damps roll does not"""
    for mode, there in ((2, True), (3, False)):
        body = OneMotion(0.05)
        body.damping[mode, mode] = 0.01
        (found,) = resonances(body)
        assert found.mode == 2 and found.viscous is there


def test_a_quarter_of_critical_damping_leaves_no_peak():
    assert len(resonances(OneMotion(0.245))) == 1 and resonances(OneMotion(0.255)) == []


def test_a_peak_below_a_thousandth_of_the_largest_motion_of_its_kind_is_none():
    """Surge of 1 m/m everywhere beside a peak of heave"""
    height = 4 * 0.05 * np.sqrt(1 - 0.05**2)
    assert len(resonances(OneMotion(0.05, 1.05e-3 * height, 1.0))) == 1
    assert resonances(OneMotion(0.05, 0.95e-3 * height, 1.0)) == []


@pytest.mark.parametrize(("ratio", "peaks"), [(0.2, 1), (0.3, 0), (-0.2, 1), (-0.3, 0)])
def test_what_is_damped_or_driven_by_more_than_a_quarter_of_critical_is_no_resonance(ratio, peaks):
    """C/(M + A) = 1 rad²/s², B = 2ζω(M + A): beyond ζ 0.25 no peak stands out, whichever its sign"""
    assert len(resonances(OneMotion(ratio))) == peaks


def test_frequencies_of_modes_are_found_beside_others_whose_bracket_grows():
    """ω² = 4/(1 + ω) lies below its first guess, ω² = 1 + ω and ω² = 1 + 9ω far above theirs; −1 has none"""
    from hakobune.bem.database.natural_periods import _own_frequencies

    def eigenvalues(w):
        w = np.asarray(w)
        return np.stack([4 / (1 + w), 1 + w, 1 + 9 * w, -1 + 0 * w], axis=-1)

    roots = [max(np.roots(p).real[np.abs(np.roots(p).imag) < 1e-9]) for p in ([1, 1, 0, -4], [1, -1, -1], [1, -9, -1])]
    assert _own_frequencies(eigenvalues) == pytest.approx([*roots, -1.0], rel=1e-9)


def test_natural_frequencies_within_the_stored_ones_are_called_by_kinetic_energy():
    """Of three coupled motions, energy |q Mq| of each, not q²: here they differ; a root beyond the band is left out"""
    from hakobune.bem.database.resonances import _roots

    rng = np.random.default_rng(3)
    differ, signed = 0, 0
    for _ in range(60):
        M, C = (a @ a.T + 0.1 * np.eye(3) for a in rng.normal(size=(2, 3, 3)))
        squares, vectors = eigh(C, M)
        roots = np.sqrt(squares)
        names = by_motion(np.abs(vectors.T * (M @ vectors).T))
        differ += names.tolist() != by_motion(vectors.T**2).tolist()
        signed += names[:2].tolist() != by_motion(vectors.T * (M @ vectors).T)[:2].tolist()
        high = 0.5 * (roots[1] + roots[2])
        body = SimpleNamespace(omega=np.linspace(0.3 * roots[0], high, 9), inertia=M, stiffness=C, free=None,
                               held_added_mass=lambda w: np.zeros((len(w), 3, 3)))  # fmt: skip
        found = list(_roots(body))
        assert [w for _, w, _ in found] == pytest.approx(roots[:2])
        for (motion, _, q), number in zip(found, (0, 1), strict=True):
            assert names[motion] == number
            assert q / q[np.abs(q).argmax()] == pytest.approx(
                vectors[:, number] / vectors[np.abs(q).argmax(), number], abs=1e-6
            )
    assert differ > 0 and signed > 0  # energies of coupled motions may be below 0 each
    body.omega = np.linspace(1.5 * roots[2], 2 * roots[2], 9)
    assert list(_roots(body)) == []


def test_inertia_that_gap_water_makes_negative_is_all_but_nothing():
    """Eigenvalues below a thousand millionth of the largest become that; where all are positive nothing changes"""
    Q = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    sound, gap = Q @ np.diag([1.0, 2, 5]) @ Q.T, Q @ np.diag([-3.0, 2, 5]) @ Q.T
    assert positive(sound) is sound
    found = positive(np.stack([sound, gap, 10 * gap]))
    assert found[0] == pytest.approx(sound, abs=1e-12)
    for one, size in ((found[1], 1.0), (found[2], 10.0)):
        assert one == pytest.approx(size * Q @ np.diag([5e-9, 2, 5]) @ Q.T, abs=1e-12 * size)
        assert np.linalg.eigvalsh(one)[0] == pytest.approx(5e-9 * size, rel=1e-4)


def test_damping_that_grows_with_the_motion_counts_at_the_height_of_the_peak():
    """ζ = (B + N)/2ω(M + A) with N of the amplitude in waves of 1.5 m; the motion is told as damped by its own"""
    law = Quadratic(0.02)
    body = OneMotion(0.05)
    body.viscous = Viscous({"heave": law}, 1.5, body.words)
    (found,) = resonances(body)
    N = 8 / (3 * np.pi) * found.omega * 1.5 * found.peak * 0.02
    assert found.damping == pytest.approx((4 * 0.05 + N) / (2 * 1.0 * 2.0), rel=1e-3) and found.viscous
    assert N > 0.02


class TwoHeadings(OneMotion):
    """Waves towards 0.3 rad excite heave half as much as those towards 1.1 rad; roll moves by much in both"""

    headings = np.array([0.3, 1.1])

    def motions(self, omega):
        X = np.repeat(super().motions(omega), 2, axis=1)
        X[:, 0] *= 0.5
        X[:, :, 3] = 5e3  # rad/m, of another kind
        return X


def test_a_peak_is_that_of_the_heading_that_excites_it_most_beside_motions_of_its_kind():
    (found,) = resonances(TwoHeadings(0.05))
    assert found.heading == 1.1 and found.name == "heave" and found.mode == 2
    assert found.peak == pytest.approx(1 / (4 * 0.05 * np.sqrt(1 - 0.05**2)), rel=1e-3)
    assert found.error == pytest.approx(0.1 * found.peak) and found.omega == pytest.approx(1.0, rel=5e-3)


def test_a_peak_at_an_end_of_the_stored_frequencies_is_the_largest_there_is():
    """A resonance at 1 rad/s beside the lowest stored frequency: the search stays inside"""
    body = OneMotion(0.05)
    body.omega = np.linspace(0.999, 2.0, 16)
    body.between = SimpleNamespace(span=(0.999, 2.0))
    (found,) = resonances(body)
    assert 0.999 <= found.omega < 1.01 and found.peak == pytest.approx(np.abs(body.motions([found.omega])[0, 0, 2]))


@pytest.mark.parametrize("change", ["inertia", "stiffness", "few"])
def test_without_inertia_stiffness_or_four_frequencies_nothing_resonates(change):
    body = OneMotion(0.05)
    if change == "few":
        body.omega = np.linspace(0.5, 2.0, 3)
    else:
        setattr(body, change, None)
    assert resonances(body) == []
    enough = OneMotion(0.05)
    enough.omega = np.linspace(0.5, 2.0, 4)
    assert len(resonances(enough)) == 1
