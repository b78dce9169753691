"""What `hakobune.earthquake` finds of a body between linear fenders, by hand as one mass on a spring."""

import math

import numpy as np
import pytest

import hakobune

M, A, N, K = 51250.0, 15000.0, 2000.0, 3000.0  # t, t, kN s/m, kN/m: three fenders of 1000 kN/m on each side
STUDY = f"""
motion = "sway"
[body]
mass = {M}
added_mass = {A}
damping = {N}
[fender]
table = "linear.csv"
height = 2.0
rated_strain = 0.5
count = 3
[spectrum]
periods = [0.1, 10.0, 30.0]
acceleration = [2.0, 0.1, 0.01]
[rule]
rule = "A"
factors = {{ coefficient = 0.005 }}
"""


def found_of(folder, more=""):
    """Result of the study in a folder"""
    (folder / "linear.csv").write_text("strain,reaction_kN\n0,0\n0.25,500\n0.5,1000\n")
    (folder / "quake.toml").write_text(STUDY + more)
    return hakobune.earthquake(folder / "quake.toml")


def test_reactions_to_rule_and_spectrum_are_those_of_one_mass_on_a_spring(tmp_path):
    """T = 2π √((M + a)/k), ζ = N/2√(k(M + a)); the spectrum of 5 % times √(0.10/(0.05 + ζ)) (EN 1998-1, 3.2.2.2); R =
    (M + a) S, deflection R/k; the coefficient is of the weight in air"""
    found = found_of(tmp_path)
    T, ratio = 2 * math.pi * math.sqrt((M + A) / K), N / (2 * math.sqrt(K * (M + A)))
    S = np.interp(T, [10.0, 30.0], [0.1, 0.01]) * math.sqrt(0.10 / (0.05 + ratio))
    assert found["stiffness[first slope].period"] == pytest.approx(T, rel=1e-9)
    assert [found["body.mass"], found["fenders.count"]] == [1e3 * M, 3]
    reaction, strain = 1e3 * (M + A) * S, (M + A) * S / K / 2.0
    by_hand = {"period": T, "damping": ratio, "acceleration": S, "reaction": reaction, "strain": strain}
    by_hand |= {"over_weight": reaction / (1e3 * M * 9.80665), "deflection": 2.0 * strain}
    for name, value in by_hand.items():  # the equivalent spring by 128 points of a cycle
        assert found[f"method[response spectrum].{name}"] == pytest.approx(value, rel=2e-3), name
    rule = {name: found[f"method[seismic coefficient 0.005].{name}"] for name in by_hand}
    force = 0.005 * 1e3 * M * 9.80665
    assert rule["acceleration"] == pytest.approx(0.005 * 9.80665, rel=1e-12) and np.isnan(rule["period"])
    assert [rule["reaction"], rule["over_weight"]] == pytest.approx([force, 0.005], rel=1e-12)
    assert rule["deflection"] == pytest.approx(force / (1e3 * K), rel=1e-6)


def test_the_normalised_reaction_is_the_transmissibility_of_the_spring(tmp_path):
    """R/(ω² y M) = (k/ω²M) |−ω²(M + a) + iωN| / |k − ω²(M + a) + iωN|: (M + a)/M and more about resonance"""
    found = found_of(tmp_path)
    for T in (2, 3, 5, 10, 20):
        w = 2 * math.pi / T
        water = complex(-(w**2) * (M + A), w * N)
        by_hand = K / (w**2 * M) * abs(water) / abs(K + water)
        assert found[f"normalised[{T:.1f}]"][0] == pytest.approx(by_hand, rel=1e-9)


def test_a_record_that_is_one_slow_swing_of_the_ground_takes_soft_fenders_along(tmp_path):
    """A sine of the ground of 10 s over one period, whose base line is made to end at rest: reaction and spectrum of
    the record by an integration of u'' = −a − (N u' + k u)/(M + a) with steps of the trapezoid's rule"""
    t = np.arange(0.0, 20.0001, 0.01)
    a = 0.08 * np.sin(2 * np.pi * t / 10.0)
    np.savetxt(tmp_path / "record.csv", np.stack([t, 100 * a], axis=1), delimiter=",", comments="",
               header="time_s,acceleration_gal")  # fmt: skip
    found = found_of(tmp_path, '\n[record]\nfile = "record.csv"\nafter = 30.0\n')
    # two shapes, 1 and t/T, that take velocity and displacement at the end to 0, by their integrals
    T, speed = t[-1], np.trapezoid(a, t)
    way = np.trapezoid((t[-1] - t) * a, t)
    c = np.linalg.solve([[T, T / 2], [T**2 / 2, T**2 / 6]], [-speed, -way])
    ground = a + c[0] + c[1] * t / T

    def largest(ratio, omega, damped_ground):
        u = v = most = 0.0
        h = 0.01
        for one in damped_ground:  # semi-implicit: second order by halves
            v += 0.5 * h * (-one - 2 * ratio * omega * v - omega**2 * u)
            u += h * v
            v = (v + 0.5 * h * (-one - omega**2 * u)) / (1 + h * ratio * omega)
            most = max(most, abs(u))
        return most

    omega, ratio = math.sqrt(K / (M + A)), N / (2 * math.sqrt(K * (M + A)))
    quiet = np.concatenate([ground, np.zeros(3000)])
    pseudo = omega**2 * largest(0.05, omega, ground) * math.sqrt(0.10 / (0.05 + ratio))
    assert found["method[spectrum of the record].reaction"] == pytest.approx(1e3 * (M + A) * pseudo, rel=0.02)
    # in time the body in space obeys (M + a) η'' + N η' = −R: with little damping the ground drives u by all of (M + a)
    assert found["method[record in time].acceleration"] == pytest.approx(np.abs(ground).max(), rel=0.01)
    assert found["method[record in time].reaction"] == pytest.approx(1e3 * K * largest(ratio, omega, quiet), rel=0.08)
