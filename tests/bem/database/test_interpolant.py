"""Functions of frequency from few values: a known function of waves, and the box of the series calculations."""

from decimal import Decimal, localcontext

import numpy as np
import pytest

from hakobune.bem.algebra.poles import poles
from hakobune.bem.database import open_database
from hakobune.bem.database.between_frequencies import Between, BetweenError
from hakobune.bem.database.interpolant import (
    FAMILY,
    NUGGET,
    Abscissa,
    Interpolant,
    Joined,
    Nodes,
    _left_open,
    _root,
    abscissa,
    chosen,
    ringing_of,
    windows,
)
from hakobune.bem.methods.panel_problem import prepare
from hakobune.bem.waves import wavenumber
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.problem import problem_of
from hakobune.pipelines.solve.run import solve

LENGTH, GRAVITY = 100.0, 9.80665


def echoing(omega, depth=20.0):
    """A damped mode, the same heard once more after the length of the body, and a constant (q, 2)"""
    k = wavenumber(omega, depth, GRAVITY)
    smooth = 1 / (0.8 - 0.4j - omega)
    return np.stack([smooth * (1 + 0.1 * np.exp(1j * k * LENGTH)), np.full_like(smooth, 2.0)], axis=1)


def fitted(count, depth=20.0):
    omega = np.linspace(0.1, 2.0, 300)
    places = abscissa(omega, depth, GRAVITY, LENGTH)
    ends = Abscissa(*(a[[0, -1]] for a in places))
    nodes = np.sort([0, 299, *chosen(ends, places, count - 2)])
    x = Abscissa(*(a[nodes] for a in places))
    fit = Interpolant(Nodes(x), echoing(omega[nodes])[..., None], np.zeros((2, 1)))
    return np.abs(fit.value(places)[..., 0] - echoing(omega)), fit.deviation(places), nodes


def test_at_its_nodes_it_has_their_values():
    error, deviation, nodes = fitted(20)
    assert error[nodes].max() < 1e-4 and deviation[nodes].max() < 1e-3  # of values up to 2.5; the nugget's share


def test_water_that_rings_between_its_nodes_is_seen_by_its_pole():
    """A pole of a fifth of the step between nodes, beside what is smooth; without it half the peak is missed"""
    omega, y = (abscissa(np.linspace(0.2, 2.0, count), np.inf, GRAVITY, GRAVITY) for count in (19, 181))  # s is ω
    pole = 1.23 - 0.02j

    def ringing(s):
        return (1 / (0.8 - 0.4j - s) + 0.02j / (pole - s))[:, None, None]

    found = ringing_of(omega, ringing(omega.smooth)[:, 0])
    assert np.isclose(found, pole, atol=1e-6)
    with_pole, without = (
        np.abs(
            Joined(omega, windows(omega, False, p), ringing(omega.smooth), np.zeros((1, 1))).value(y)
            - ringing(y.smooth)
        )
        for p in (found, ())
    )
    assert with_pole.max() < 0.01 and without.max() > 0.5


@pytest.mark.parametrize("noise, count", [(1e-4, 1), (0.1, 0)])
def test_noise_makes_no_poles(noise, count):
    x = np.linspace(0.0, 2.0, 40)
    values = 1 / (x - 1.1 + 0.05j)[:, None] + 20 * noise * np.random.default_rng(1).normal(size=(40, 2))
    assert len(ringing_of(Abscissa(x, x), values)) == count


def test_a_node_that_is_off_by_itself_makes_no_pole():
    x = np.linspace(0.0, 2.0, 40)
    values = 1 / (x - 1.1 + 0.5j)[:, None] + 0.1 * np.eye(40)[:, [20]]
    assert len(ringing_of(Abscissa(x, x), values)) == 0 < len(poles(x, values)[0])


@pytest.mark.parametrize("moving", [[], [1], [0, 1, 2]])
def test_functions_that_are_zero_at_every_node_are_zero_between_without_an_error(moving):
    """And change nothing of the others, to rounding"""
    omega, places = np.linspace(0.2, 1.2, 9), abscissa(np.linspace(0.2, 1.2, 40), 20.0, GRAVITY, LENGTH)
    x, values = abscissa(omega, 20.0, GRAVITY, LENGTH), np.zeros((9, 3, 2), complex)
    values[:, moving] = echoing(omega)[:, None]
    fit = Joined(x, windows(x), values, np.zeros((3, 2)))
    alone = Joined(x, windows(x), echoing(omega)[:, None], np.zeros((1, 2)))
    for found, single in ((fit.value(places), alone.value(places)), (fit.deviation(places), alone.deviation(places))):
        expected = np.zeros_like(found)
        expected[:, moving] = single
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("member", [FAMILY[0], FAMILY[-1]])
def test_the_variance_left_open_is_exact_to_the_nugget(member):
    """Of 24 nodes, as in a band that is nearly known, against forty digits; entries of the inverse are 1e9"""
    omega = np.linspace(0.1, 2.0, 300)
    places = abscissa(omega, 100.0, GRAVITY, LENGTH)
    nodes = np.sort([0, 299, *chosen(Abscissa(*(a[[0, -1]] for a in places)), places, 22)])
    x, y = (Abscissa(*(a[some] for a in places)) for some in (nodes, slice(None, None, 23)))
    kernel, row = member.kernel(x, x).real, member.kernel(y, x).real
    n, both = len(nodes), np.block([[kernel, row.T], [row, np.eye(len(row))]])
    with localcontext(prec=40):
        exact = np.vectorize(Decimal, otypes=[object])(both)
        exact[range(n), range(n)] += Decimal(NUGGET)
        for i in range(n):  # what is left of the corner is 1 − r κ⁻¹ r*
            exact[i + 1 :] -= np.multiply.outer(exact[i + 1 :, i] / exact[i, i], exact[i])
    np.testing.assert_allclose(
        _left_open(row, _root(kernel)), np.diag(exact)[n:].astype(float), rtol=0, atol=NUGGET / 10
    )


def test_the_error_falls_faster_than_the_eighth_power_of_the_number_of_nodes():
    coarse, fine = fitted(14)[0].max(), fitted(28)[0].max()
    assert fine < coarse / 2**8


@pytest.mark.parametrize("count", [14, 18, 22, 26, 28])
def test_the_largest_deviation_is_not_less_than_the_largest_error(count):
    error, deviation, _ = fitted(count)
    assert deviation.max() > error.max()


def test_nodes_are_chosen_apart_and_once():
    for count in (12, 24, 60):
        nodes = fitted(count)[2]
        assert len(set(nodes)) == count


def band_scene(**changes):
    raw = {
        "water": {"depth": 20.0},
        "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0, "gyration": [17, 29, 29]}],
        "waves": {"band": {"from": 0.1, "to": 2.0}, "headings_deg": [0, 45, 90]},
        "tolerance": 0.005,
        "want": ["radiation", "diffraction", "motions"],
    }
    return make_scene({**raw, **changes})


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    path = tmp_path_factory.mktemp("band") / "box.h5"
    return solve(band_scene(), path), open_database(path)


def direct(db, omega, names):
    body = prepare(problem_of(db.header, band_scene()))
    rows = [body.run(w, db.wave_direction, set(names), None, tuple(db["influenced_dof"])).result() for w in omega]
    return {name: np.array([row[name] for row in rows]) for name in names}


def test_25_solves_give_the_series_box_from_0p1_to_2_to_half_a_per_cent(solved):
    outcome, db = solved
    assert outcome.exit_status == 0 and len(db.omega) == outcome.solved <= 25
    omega = np.linspace(0.1, 2.0, 400)[5::27]  # of the 400 of tests/bench/band.py
    exact = direct(db, omega, ("added_mass", "radiation_damping", "excitation_force", "rao"))
    for name in ("added_mass", "radiation_damping"):
        scale = np.sqrt(np.einsum("nii->ni", db[name]).max(axis=0))
        assert np.max(np.abs(db.at(omega, name)[0] - exact[name]) / np.outer(scale, scale)) < 0.005
    for name in ("excitation_force", "rao"):
        scale = np.abs(db[name]).max(axis=(0, 1))
        assert np.max(np.abs(db.at(omega, name)[0] - exact[name]) / scale) < 0.005


def test_a_band_within_tolerance_asks_for_nothing_more(solved):
    _, db = solved
    again = solve(band_scene(), db.path)
    assert again.jobs == 0 and again.total == len(db.omega) and again.exit_status == 0


def test_outside_the_stored_band_and_without_what_it_follows_from_nothing_is_guessed(solved):
    _, db = solved
    with pytest.raises(BetweenError, match=r"omega is 2.2 rad/s \(period 2.856 s\), outside the stored 0.1 to 2 rad/s"):
        db.at(2.2, "radiation_damping")
    with pytest.raises(BetweenError, match="kochin_radiation, kochin_diffraction must be stored"):
        db.at(1.0, "drift_force")
    with pytest.raises(BetweenError, match="is not a function of frequency"):
        db.at(1.0, "mesh")
    added = db["added_mass"]
    few = Between(db.omega[:3], {"added_mass": added[:3]}, 20.0, GRAVITY, np.zeros(1), np.zeros(1), np.eye(2))
    assert np.array_equal(few.value(db.omega[1], "added_mass")[0], added[1])
    with pytest.raises(BetweenError, match=r"omega is 0\.11 rad/s, which is not stored; interpolation needs at least"):
        few.value(0.11, "added_mass")


@pytest.fixture(scope="module")
def drifting(tmp_path_factory):
    path = tmp_path_factory.mktemp("drift") / "box.h5"
    outcome = solve(band_scene(tolerance=0.01, want=["radiation", "diffraction", "kochin", "drift"]), path)
    assert "(tolerance 1 %), and more for drift" in outcome.remarks[-1]
    return open_database(path)


DRIFTS = ("drift_force_fixed", "drift_force")


@pytest.fixture(scope="module")
def exact_drift(drifting):
    """Frequencies between the stored ones, rad/s, and the drift solved at them"""
    omega = np.linspace(0.12, 1.98, 21)
    return omega, direct(drifting, omega, DRIFTS)


@pytest.mark.parametrize("name", DRIFTS)
def test_nine_of_ten_drifts_between_frequencies_are_within_three_of_the_deviations_they_are_given(
    drifting, exact_drift, name
):
    db, (omega, solved) = drifting, exact_drift
    exact = solved[name]
    value, error = db.at(omega, name)
    scale = np.abs(db[name]).max(axis=(0, 1))
    wrong, told = (np.abs(value - exact) / scale, error / scale)
    counts = np.maximum(wrong, told) > 1e-6  # what symmetry makes zero is rounding
    assert np.mean((wrong < 3 * told)[counts]) >= 0.9
    rms = [np.sqrt(np.mean(part**2, axis=(0, 1))) for part in (wrong, told)]
    assert np.all(rms[0] < 2 * rms[1])
    if name == "drift_force_fixed":
        assert np.all(rms[0] < [0.01, 0.01, 0.03])


def test_kochin_functions_keep_their_values_where_they_are_small(drifting):
    """H of long waves is a hundredth of that of short ones; a fit that knows one size would lose it"""
    db = drifting
    value, _ = db.at(db.omega, "kochin_diffraction")
    size = np.abs(db["kochin_diffraction"]).max(axis=-1, keepdims=True)
    assert size[0].max() < size[-1].max() / 100
    assert np.max(np.abs(value - db["kochin_diffraction"]) / size) < 0.01


def test_the_variance_left_open_beside_ringing_water_is_that_of_the_kernel_itself():
    """κ(y, y) − κ(y, x) κ(x, x)⁻¹ κ(x, y) of four nodes far apart, with κ(y, y) above 1 by that of the pole"""
    omega = np.array([0.3, 0.8, 1.3, 1.9])
    nodes = Nodes(abscissa(omega, 100.0, GRAVITY, LENGTH), ringing=np.array([1.7 - 0.02j, 3.0 - 0.1j]))
    y = abscissa(np.array([0.5, 0.55, 1.0, 1.6]), 100.0, GRAVITY, LENGTH)
    own = np.einsum("kii->ki", nodes._kernels(y, y)).real
    row, known = nodes._kernels(y, nodes.x), nodes._kernels(nodes.x, nodes.x)
    seen = np.einsum("kqn,knq->kq", row, np.linalg.solve(known, row.conj().swapaxes(1, 2))).real
    assert own.max() > 1.5 and nodes.rows(y).left == pytest.approx(own - seen, abs=1e-6)
