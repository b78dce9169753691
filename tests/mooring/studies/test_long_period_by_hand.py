"""One slow motion by hand: its added mass, its damping, the spectrum of its displacement."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.loads.box_current import current_force
from hakobune.mooring.studies import long_period as of_long_periods
from hakobune.mooring.studies.conditions import Current, ExposedBox
from hakobune.mooring.studies.long_period import _one, long_period

MASS, BAND = 3.0e6, np.array([0.2, 2.0])


def body(added, damping=lambda omega: 0.0):
    """Of a mass in surge alone, added(ω) and damping(ω) between the frequencies BAND"""

    def alone(value):
        found = np.zeros((1, 6, 6))
        found[0, 0, 0] = value
        return found

    def coefficients(omega):
        assert BAND[0] <= omega[0] <= BAND[1]
        return alone(added(omega[0])), alone(damping(omega[0]))

    inertia = alone(MASS)[0]
    return SimpleNamespace(
        inertia=inertia, omega=BAND, held_added_mass=lambda omega: alone(added(float(omega))), coefficients=coefficients
    )


def one(held, K, N, omega=None, force=None):
    omega = np.linspace(0, 1.0, 20001)[1:] if omega is None else omega
    force = np.full(len(omega), 1e8) if force is None else force
    return _one(held, K, 0, omega, force, 0.0, lambda sigma: N, 0.0)


@pytest.mark.parametrize("natural", [0.05, 0.3, 0.8])
def test_added_mass_is_that_of_the_natural_frequency(natural):
    """K = ω²{m + A(ω)}, A = 10⁶ (1 + ω/5) kg"""
    added = lambda omega: 1e6 * (1 + omega / 5)  # noqa: E731
    K = natural**2 * (MASS + added(natural))
    period, damping, _ = one(body(added), K, 2e4)
    assert period == pytest.approx(2 * math.pi / natural, rel=1e-5)
    assert damping == pytest.approx(2e4 / (natural * (MASS + added(natural))), rel=1e-5)


@pytest.mark.parametrize(("natural", "share"), [(0.05, 0.25), (0.1, 0.5), (0.2, 1.0), (0.9, 1.0)])
def test_radiation_below_the_stored_frequencies_falls_with_frequency(natural, share):
    """ν = N/√(mK) = N/(m ω₀), with the damping of the first stored frequency times its share below it"""
    mass = MASS + 1e6
    radiated = lambda omega: 1e5 * omega  # noqa: E731
    period, damping, _ = one(body(lambda omega: 1e6, radiated), mass * natural**2, 0.0)
    assert period == pytest.approx(2 * math.pi / natural)
    assert damping == pytest.approx(share * radiated(max(natural, 0.2)) / (mass * natural))


def test_a_flat_spectrum_gives_the_closed_form():
    """σ² = π S/(2 N K) of a force of S over every frequency"""
    mass, natural, N, S = MASS + 1e6, 0.3, 1.2e5, 1e8
    omega = np.linspace(0, 40.0, 400001)[1:]
    K = mass * natural**2
    found = one(body(lambda omega: 1e6), K, N, omega, np.full(len(omega), S))
    assert found[2] == pytest.approx(math.sqrt(math.pi * S / (2 * N * K)), rel=1e-4)


def test_damping_is_of_its_own_velocity_and_that_of_the_waves_together():
    """N = c √(σ_w² + σ_v²), σ_v² = π S/(2 N m) of a flat spectrum: solved by bisection"""
    mass, natural, S, waves, c = MASS + 1e6, 0.3, 1e10, 0.2, 2e5
    low, high = 1.0, 1e7
    for _ in range(200):
        N = math.sqrt(low * high)
        if c * math.sqrt(waves**2 + math.pi * S / (2 * N * mass)) > N:
            low = N
        else:
            high = N
    omega = np.linspace(0, 60.0, 600001)[1:]
    K = mass * natural**2
    force = np.full(len(omega), S)
    _, damping, spread = _one(body(lambda omega: 1e6), K, 0, omega, force, waves, lambda sigma: c * sigma, 0.0)
    assert damping == pytest.approx(N / math.sqrt(mass * K), rel=2e-3)
    assert spread == pytest.approx(math.sqrt(math.pi * S / (2 * N * K)), rel=2e-3)


@pytest.mark.parametrize("K", [0.0, -10.0])
def test_nothing_holds_a_motion_without_stiffness(K):
    assert np.isnan(one(body(lambda omega: 1e6), K, 1.0)).all()


HULL, MOVED = ExposedBox(100.0, 50.0, 10.0, 10.0), (0, 1, 5)
MASSES, HELD = np.array([4e7, 6e7, 5e10]), np.array([4e5, 9e5, -1.0])  # kg, kg m²; N/m
SLOPES, BEYOND = np.array([3e5, 4e5, 5e9]), np.array([2e4, 5e4, 7e9])  # S_F of drift and of the waves, N² s
SPLIT, GUSTS = 0.35, 1e10


@pytest.fixture
def moored(monkeypatch):
    """A function (gusts, drift damping) → LongPeriod of a barge in still water, forces as above over every frequency"""
    inertia = np.zeros((6, 6))
    inertia[MOVED, MOVED] = MASSES
    body = SimpleNamespace(
        inertia=inertia, omega=BAND, held_added_mass=lambda omega: np.zeros((1, 6, 6)),
        coefficients=lambda omega: (np.zeros((1, 6, 6)), np.zeros((1, 6, 6))),
    )  # fmt: skip
    spectrum = SimpleNamespace(quantile=lambda share: SPLIT if share == of_long_periods.LOWEST else None)
    sea, asked = SimpleNamespace(spectrum=spectrum), {}

    def flat(values):
        return lambda omega: np.broadcast_to(values, (len(omega), *np.shape(values))).copy()

    def gusty(gusts, mean, omega):
        asked.update(gusts=gusts, mean=list(mean))
        return flat(np.full((3, 3), GUSTS))(omega)

    monkeypatch.setattr(of_long_periods, "sea_of", lambda conditions: sea)
    monkeypatch.setattr(of_long_periods, "on_current", lambda reader, carrier: (reader, carrier))
    monkeypatch.setattr(of_long_periods, "carrier_of", lambda current: current)
    monkeypatch.setattr(of_long_periods, "in_sea", lambda one, sea: (body, None) if one == ("reader", None) else None)
    monkeypatch.setattr(of_long_periods, "drift_of_sea", lambda body, sea: SimpleNamespace(
        slow_spectrum=flat(np.diag(SLOPES) + 1e5 * (1 - np.eye(3)))))  # fmt: skip
    monkeypatch.setattr(of_long_periods, "wave_spectrum", lambda body, sea, omega: flat(BEYOND)(omega))
    monkeypatch.setattr(of_long_periods, "gust_spectrum", gusty)

    def of(gusts, damping):
        moments = SimpleNamespace(m2=np.array([0.04, 0.09, 9.0, 9.0, 9.0, 1e-6]))
        state = SimpleNamespace(moments=moments, slow=SimpleNamespace(damping=damping))
        monkeypatch.setattr(of_long_periods, "sea_state", lambda body, sea, duration: state)
        stiffness = np.zeros((6, 6))
        stiffness[MOVED, MOVED] = HELD
        result = SimpleNamespace(
            conditions=SimpleNamespace(current=None, duration=3600.0), equilibrium=SimpleNamespace(stiffness=stiffness),
            loads={"drift": np.array([-8e3, 3e4, 1.0, 2.0, 3.0, 5e5]), "wind": np.arange(6.0)},
        )  # fmt: skip
        db = SimpleNamespace(reader="reader", density=1000.0, water_depth=20.0)
        return long_period(db, HULL, result, gusts), asked

    return of


@pytest.mark.parametrize("gusts", [None, "gusts"])
@pytest.mark.parametrize("damping", [None, np.array([[6e4, 1e9], [1e9, 8e4], [1e9, 1e9]])])
def test_each_motion_is_an_oscillator_under_drift_gusts_and_waves_below_the_split(gusts, damping, moored):
    """N = √(8/π) c √(σ_w² + σ_v²) + B of drift; σ² = ∫ S/{(K − mω²)² + (Nω)²} dω up to the split, trapezoidal"""
    found, asked = moored(gusts, damping)
    omega = np.linspace(0.0, SPLIT, 2001)[1:]
    assert found.split == SPLIT and asked.get("mean", [0, 1, 5]) == [0, 1, 5] and ("gusts" in asked) == bool(gusts)
    assert found.static[:2] == pytest.approx([8e3 / 4e5, 3e4 / 9e5]) and np.isnan(found.static[2])
    assert np.isnan([found.period[2], found.damping[2], found.quick[2], found.by_spectrum[2]]).all()
    for j, angle in enumerate((0.0, math.pi / 2)):
        m, K, waves = MASSES[j], HELD[j], (0.2, 0.3)[j]
        drag = abs(current_force(1.0, angle, HULL.length, HULL.beam, HULL.draft, 1000.0, None, 20.0)[j])
        S = SLOPES[j] + BEYOND[j] + (GUSTS if gusts else 0.0)
        more = 0.0 if damping is None else damping[j, j]
        speed = 0.0
        for _ in range(200):
            N = math.sqrt(8 / math.pi) * drag * math.hypot(waves, speed) + more
            response = S / ((K - m * omega**2) ** 2 + (N * omega) ** 2)
            speed = 0.5 * (speed + math.sqrt(np.trapezoid(omega**2 * response, omega)))
        assert found.period[j] == pytest.approx(2 * math.pi * math.sqrt(m / K))
        assert found.damping[j] == pytest.approx(N / math.sqrt(m * K), rel=2e-2)  # 24 nodes at the corner of v|v|
        assert found.by_spectrum[j] == pytest.approx(math.sqrt(np.trapezoid(response, omega)), rel=2e-2)
        assert found.quick[j] == pytest.approx(found.static[j] / (2 * found.damping[j]))


@pytest.mark.parametrize(("speed", "sigma", "C"), [(1e-6, 0.3, 0.5), (0.5, 0.01, 1.05)])
def test_a_slow_current_does_not_double_the_damping_of_a_round_hull(speed, sigma, C):
    """Still water: √(8/π) ½ρ C_D D d σ; a current far above the motion: along it 2 ½ρ C_D D d U, across it half"""
    hull, pull = ExposedBox(16.0, 16.0, 6.0, 4.0, is_round=True), 500.0 * C * 16 * 6
    current = Current(speed, 0.0)
    drag = of_long_periods._drag_of(current, hull, SimpleNamespace(density=1000.0, water_depth=24.0))
    along, across = (math.sqrt(8 / math.pi) * sigma,) * 2 if speed < sigma else (2 * speed, speed)
    assert drag(0, sigma) == pytest.approx(pull * along, rel=5e-3)
    assert drag(1, sigma) == pytest.approx(pull * across, rel=5e-3)
