"""What `hakobune earthquake` prints of a body between linear fenders, by hand as one mass on a spring."""

import csv
import io
import math

import numpy as np
import pytest

from hakobune.pipelines import cli

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


def tables(folder, capsys, more=""):
    """Rows of both printed tables, {first cell: [cells]}"""
    (folder / "linear.csv").write_text("strain,reaction_kN\n0,0\n0.25,500\n0.5,1000\n")
    (folder / "quake.toml").write_text(STUDY + more)
    assert cli.main(["earthquake", str(folder / "quake.toml"), "--csv"]) == 0
    out, said = capsys.readouterr()
    return {row[0]: row[1:] for row in csv.reader(io.StringIO(out)) if row}, said


def test_reactions_to_rule_and_spectrum_are_those_of_one_mass_on_a_spring(tmp_path, capsys):
    """T = 2π √((M + a)/k), ζ = N/2√(k(M + a)); the spectrum of 5 % times √(0.10/(0.05 + ζ)) (EN 1998-1, 3.2.2.2); R =
    (M + a) S, deflection R/k; the coefficient is of the weight in air"""
    rows, said = tables(tmp_path, capsys)
    T, ratio = 2 * math.pi * math.sqrt((M + A) / K), N / (2 * math.sqrt(K * (M + A)))
    S = np.interp(T, [10.0, 30.0], [0.1, 0.01]) * math.sqrt(0.10 / (0.05 + ratio))
    assert f"sway: {M:.0f} t, 3 × linear.csv on each side, 0 m off; period {T:.1f} s (first slope)" in said
    period, damping, acceleration, reaction, share, deflection, strain = (float(x) for x in rows["response spectrum"])
    assert period == pytest.approx(T, abs=0.06) and damping == pytest.approx(100 * ratio, abs=0.06)
    assert acceleration == pytest.approx(S, rel=0.01) and reaction == pytest.approx((M + A) * S, rel=2e-3)
    assert share == pytest.approx((M + A) * S / (M * 9.80665), abs=6e-4)
    assert deflection == pytest.approx((M + A) * S / K, abs=6e-4)
    assert strain == pytest.approx(100 * (M + A) * S / K / 2.0, abs=0.06)
    by_rule = rows["seismic coefficient 0.005"]
    assert float(by_rule[2]) == pytest.approx(0.049, abs=1e-4)
    assert float(by_rule[3]) == pytest.approx(0.005 * M * 9.80665, abs=1)
    assert float(by_rule[4]) == pytest.approx(0.005, abs=6e-4)
    assert float(by_rule[5]) == pytest.approx(0.005 * M * 9.80665 / K, abs=6e-4)


def test_the_normalised_reaction_is_the_transmissibility_of_the_spring(tmp_path, capsys):
    """R/(ω² y M) = (k/ω²M) |−ω²(M + a) + iωN| / |k − ω²(M + a) + iωN|: (M + a)/M and more about resonance"""
    rows, _ = tables(tmp_path, capsys)
    for T in (2, 3, 5, 10, 20):
        w = 2 * math.pi / T
        water = complex(-(w**2) * (M + A), w * N)
        by_hand = K / (w**2 * M) * abs(water) / abs(K + water)
        assert float(rows[f"{T}"][0]) == pytest.approx(by_hand, abs=6e-4)


def test_a_record_that_is_one_slow_swing_of_the_ground_takes_soft_fenders_along(tmp_path, capsys):
    """A sine of the ground of 10 s over one period, whose base line is made to end at rest: reaction and spectrum of
    the record by an integration of u'' = −a − (N u' + k u)/(M + a) with steps of the trapezoid's rule"""
    t = np.arange(0.0, 20.0001, 0.01)
    a = 0.08 * np.sin(2 * np.pi * t / 10.0)
    np.savetxt(tmp_path / "record.csv", np.stack([t, 100 * a], axis=1), delimiter=",", comments="",
               header="time_s,acceleration_gal")  # fmt: skip
    rows, _ = tables(tmp_path, capsys, '\n[record]\nfile = "record.csv"\nafter = 30.0\n')
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
    assert float(rows["spectrum of the record"][3]) == pytest.approx((M + A) * pseudo, rel=0.02)
    # in time the body in space obeys (M + a) η'' + N η' = −R: with little damping the ground drives u by all of (M + a)
    assert float(rows["record in time"][2]) == pytest.approx(np.abs(ground).max(), rel=0.01)
    assert float(rows["record in time"][3]) == pytest.approx(K * largest(ratio, omega, quiet), rel=0.08)
