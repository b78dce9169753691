"""Damping from synthetic records, by what they were made of; laws of energy and extinction."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from hakobune.mooring.identification.decay import decay
from hakobune.mooring.identification.forced import forced
from hakobune.mooring.identification.record import RecordError

A, B1, B2 = 2e6, 32e3, 35e3  # kg, N s/m, N s²/m²: a ferry, Shiraishi et al., table 3
OMEGA, X = 2 * np.pi / 60.0, 5.0
LINEAR, QUADRATIC = 0.006, 0.004  # 1/s, 1/m
TIME = np.arange(0.0, 600.0, 1.0)


def moved(noise=0.0, seed=1):
    rng, t = np.random.default_rng(seed), np.arange(0.0, 600.0, 0.5)
    theta = OMEGA * t + 0.3
    v = X * OMEGA * np.cos(theta)
    F = A * OMEGA**2 * X * np.sin(theta) - B1 * v - B2 * v * np.abs(v)
    chance = [part.std() * noise * rng.standard_normal(len(t)) for part in (X * np.sin(theta), F)]
    return t, X * np.sin(theta) + chance[0], F + chance[1]


def free_decay():
    def rate(_, y):
        return (y[1], -LINEAR * y[1] - QUADRATIC * y[1] * abs(y[1]) - OMEGA**2 * y[0])

    settings = {"t_eval": TIME, "rtol": 1e-11, "atol": 1e-12, "method": "DOP853"}
    return solve_ivp(rate, (0.0, TIME[-1]), (10.0, 0.0), **settings).y[0]


@pytest.fixture(scope="module")
def let_go():
    return free_decay()


def test_forced_oscillation_gives_back_what_it_was_made_of():
    found = forced(*moved())
    assert (found.added_mass, found.linear, found.quadratic) == pytest.approx((A, B1, B2), rel=1e-9)
    assert found.by_harmonics == pytest.approx((B1, B2), rel=1e-6)
    assert found.same_energy == pytest.approx(B1 + 8 / (3 * np.pi) * OMEGA * X * B2, rel=1e-9)


def test_a_cube_is_told_from_a_square_by_what_is_left():
    t, x, F = moved()
    v = X * OMEGA * np.cos(OMEGA * t + 0.3)
    made = forced(t, x, F + B2 * v * np.abs(v) - 0.5 * B2 * v**3)
    assert made.with_cubic[:2] == pytest.approx((B1, 0.5 * B2), rel=1e-8)
    assert made.with_cubic[2] < 1e-8 < 1e-4 < made.off and forced(t, x, F).with_cubic[2] > 1e-4
    rates = lambda _, y: (y[1], -LINEAR * y[1] - QUADRATIC * y[1] ** 3 - OMEGA**2 * y[0])  # noqa: E731
    alone = solve_ivp(rates, TIME[[0, -1]], (X, 0.0), "DOP853", TIME, rtol=1e-11, atol=1e-12).y[0]
    found = decay(TIME, alone)
    assert found.with_cubic[:2] == pytest.approx((LINEAR, QUADRATIC), rel=1e-6)
    assert found.with_cubic[2] < 1e-6 < found.off


def test_one_coefficient_of_the_same_force_is_that_of_the_paper():
    """50.7 and 50.3 kN s/m at 120 s, of B₁ and B₂ of table 3"""
    for amplitude, first, second, wanted in ((5.0, 37.0, 52.5, 50.7), (10.0, 32.2, 34.5, 50.3)):
        made = forced(*moved())._replace(linear=first, quadratic=second)
        made = made._replace(motion=made.motion._replace(omega=2 * np.pi / 120.0, amplitude=amplitude))
        assert made.same_force == pytest.approx(wanted, abs=0.15)


@pytest.mark.parametrize("noise, off", [(0.01, 0.02), (0.05, 0.10)])
def test_noise_moves_the_damping_of_a_forced_oscillation_within_its_limit(noise, off):
    """Of one coefficient with the same energy; B₁ and B₂ alone trade against each other, twice and more as much"""
    exact = B1 + 8 / (3 * np.pi) * OMEGA * X * B2
    for seed in range(10):
        assert forced(*moved(noise, seed)).same_energy == pytest.approx(exact, rel=off)


def test_linear_and_quadratic_damping_scatter_as_little_as_any_unbiased_estimate_can():
    """The bound of Cramér and Rao for noise of the force of 5 %: 4.9 and 9.8 % of each; as much is told of one record

    Sixty records know their scatter to 9 %; three times that is allowed.
    """
    noise, (t, _, F) = 0.05, moved()
    v = X * OMEGA * np.cos(OMEGA * t + 0.3)
    columns = np.stack([X * OMEGA**2 * np.sin(OMEGA * t + 0.3), v, v * np.abs(v), np.ones_like(t)], axis=1)
    bound = noise * F.std() * np.sqrt(np.diag(np.linalg.inv(columns.T @ columns)))[1:3]
    found = [forced(*moved(noise, seed)) for seed in range(60)]
    scatter = np.std([(one.linear, one.quadratic) for one in found], axis=0)
    told = np.mean([one.error for one in found], axis=0)
    assert np.all(scatter < 1.27 * bound) and np.allclose(told, scatter, rtol=0.27), (scatter / bound, told / scatter)
    assert np.all(bound < 0.1 * np.array([B1, B2]))


def test_free_decay_gives_back_what_it_was_made_of(let_go):
    found = decay(TIME, let_go)
    assert (found.linear, found.quadratic, found.omega) == pytest.approx((LINEAR, QUADRATIC, OMEGA), rel=1e-6)
    assert found.a == pytest.approx(0.5 * np.pi * LINEAR / OMEGA, rel=0.01)  # to the first power of the damping
    assert found.b == pytest.approx(4 / 3 * QUADRATIC, rel=0.02)
    assert found.linear_only > found.a


@pytest.mark.parametrize("noise, off", [(0.01, 0.02), (0.05, 0.10)])
def test_noise_moves_the_damping_of_a_free_decay_within_its_limit(let_go, noise, off):
    chance = np.random.default_rng(7).standard_normal(len(TIME))
    found = decay(TIME, let_go + noise * let_go.std() * chance)
    share = 8 / (3 * np.pi) * OMEGA * X
    assert found.linear + share * found.quadratic == pytest.approx(LINEAR + share * QUADRATIC, rel=off)


@pytest.mark.parametrize(
    "make, says",
    [
        (
            lambda: decay(np.delete(TIME, 50), np.delete(np.sin(TIME), 50)),
            "is 2 s after 49 s and 1 s elsewhere;",
        ),
        (lambda: decay(TIME, np.full(600, np.nan)), "row 1 of the record has a value that is not a number"),
        (
            lambda: decay(TIME, np.exp(0.002 * TIME) * np.cos(OMEGA * TIME)),
            "in half a cycle; allowed: a motion that decays",
        ),
        (lambda: decay(TIME, np.exp(-0.1 * TIME)), "crosses its mean"),
        (lambda: forced(TIME[:10], TIME[:10], TIME[:10]), "10 times; allowed: 16 or more"),
        (lambda: forced(TIME[:50], np.sin(OMEGA * TIME[:50]), TIME[:50]), "cycles; allowed: two or more"),
    ],
)
def test_an_impossible_record_is_refused_in_one_line(make, says):
    with pytest.raises(RecordError) as caught:
        make()
    assert says in str(caught.value) and "\n" not in str(caught.value)
