"""`hakobune damping` as a user calls it."""

import json
from types import SimpleNamespace

import numpy as np
import pytest
from made_up_body import INERTIA, made_up_body

import hakobune
from hakobune.pipelines import cli

T = np.arange(0.0, 400.0, 1.0)
OMEGA = 2 * np.pi / 50.0


def written(path, **columns):
    rows = np.stack(list(columns.values()), axis=1)
    np.savetxt(path, rows, delimiter=",", header=",".join(columns), comments="")
    return str(path)


def test_a_forced_oscillation_is_told_and_drawn(tmp_path, capsys):
    v = 3.0 * OMEGA * np.cos(OMEGA * T)
    force = 1500 * 3.0 * OMEGA**2 * np.sin(OMEGA * T) - 40.0 * v - 25.0 * v * np.abs(v)
    path = written(tmp_path / "forced.csv", time_s=T, motion_m=3.0 * np.sin(OMEGA * T), force_kN=force)
    assert cli.main(["damping", path, "--plot", str(tmp_path / "f.png"), "--output", str(tmp_path / "f.h5")]) == 0
    assert cli.main(["damping", path, "--output", path]) == 2  # the record itself
    told = capsys.readouterr().out
    rows = hakobune.damping(path)
    assert hakobune.read(tmp_path / "f.h5")["B1"] == rows["B1"]
    assert [rows[name] for name in ("added_mass", "B1", "B2")] == pytest.approx([1500e3, 40e3, 25e3], rel=1e-4)
    assert rows["fitted.force"] == pytest.approx(1e3 * force, abs=0.1)
    assert (tmp_path / "f.png").stat().st_size > 5000 and "negative" not in told
    turned = written(tmp_path / "turned.csv", time_s=T, motion_m=3.0 * np.sin(OMEGA * T), force_kN=-force)
    assert cli.main(["damping", turned]) == 1
    assert "FAILS: the equivalent damping by energy is negative" in capsys.readouterr().out


def test_a_free_decay_is_told_with_its_mass(tmp_path, capsys):
    ratio = 0.04
    turn = OMEGA * np.sqrt(1 - ratio**2)
    path = written(tmp_path / "decay.csv", time_s=T, motion_m=2.0 * np.exp(-ratio * OMEGA * T) * np.cos(turn * T))
    assert cli.main(["damping", path, "--mass", "5000"]) == 0
    rows = hakobune.damping(path, mass=5e6)
    assert f"{rows['critical'] * 100:.4g} │ %" in capsys.readouterr().out
    assert rows["critical"] == pytest.approx(ratio, rel=1e-3) and rows["period"] == pytest.approx(50, rel=1e-3)
    assert rows["B1"] == pytest.approx(2 * ratio * OMEGA * 5e6, rel=1e-3)


def test_a_roll_decay_has_its_damping_in_moments_as_a_study_takes_it(tmp_path, capsys):
    """Of I = 2e9 kg m², 5 % of critical, from 10°: B₁ = 2 ζ Ω I"""
    ratio, inertia = 0.05, 2e9
    x = 10.0 * np.exp(-ratio * OMEGA * T) * np.cos(OMEGA * np.sqrt(1 - ratio**2) * T)
    path = written(tmp_path / "roll.csv", time_s=T, motion_deg=x)
    assert cli.main(["damping", path, "--mass", "2e6"]) == 0
    B1, rows = 2 * ratio * OMEGA * inertia, hakobune.damping(path, mass=inertia)
    assert rows["B1"] == pytest.approx(B1, rel=1e-3) and rows.quantity("B1").unit == "N m s"
    assert rows["record.motion"] == pytest.approx(np.radians(x))
    said = " ".join(capsys.readouterr().out.split())
    assert f"linear_damping = {{ roll = {rows['B1'] / 1e3:.4g} }}" in said
    both = written(tmp_path / "both.csv", time_s=T, motion_deg=x, force_kN=x)
    assert cli.main(["damping", both]) == 2 and "motion_deg and moment_kNm" in capsys.readouterr().err


def test_a_record_of_something_else_fails(tmp_path, capsys):
    t = T[: len(T) // 4]
    noise = np.random.default_rng(1).standard_normal(len(t))
    path = written(tmp_path / "noise.csv", time_s=t, motion_m=np.exp(-0.01 * t) * np.cos(OMEGA * t) + noise)
    assert cli.main(["damping", path]) == 1
    assert (
        "of the motion is not explained, limit 25 %; this is not a record of the free decay" in capsys.readouterr().out
    )


@pytest.mark.parametrize("head", [
    "t (s),roll (deg)", "Time [s],Heave [m]", "time_s,pitch_deg", "t (ms),surge (mm)", "time (s),yaw (rad)",
])  # fmt: skip
@pytest.mark.parametrize(("period", "ratio", "step", "digits"), [(41.56, 0.027, 0.8144, 1), (9.75, 0.06, 0.1711, 2)])
def test_a_decay_names_its_own_motion_and_times_are_written_with_few_digits(
    head, period, ratio, step, digits, tmp_path, capsys
):
    """x = e^{−ζωt} cos ω√(1 − ζ²) t: of period 2π/ω√(1 − ζ²) or 2π/ω, a thousandth apart; B1 is ζ of critical"""
    omega, n = 2 * np.pi / period, int(8 * period / step)
    t = np.arange(n) * step
    x = 0.2 * np.exp(-ratio * omega * t) * np.cos(omega * np.sqrt(1 - ratio**2) * t)
    clock, size = 1e3 if "ms" in head else 1.0, 1e3 if "mm" in head else 10.0 if "deg" in head else 1.0
    rows = [f"{clock * round(a, digits):.{digits}f},{size * b:.6f}" for a, b in zip(t, x, strict=True)]
    (tmp_path / "d.csv").write_text("\n".join([head, *rows]) + "\n")
    assert cli.main(["damping", str(tmp_path / "d.csv"), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["quantities"]
    shown = {name: one["values"] for name, one in found.items()}
    assert shown["period"] == pytest.approx(period, rel=3e-3)
    assert next(v for k, v in shown.items() if "critical" in k) == pytest.approx(ratio, rel=0.03)


@pytest.mark.parametrize(
    "text, flags, says",
    [
        ("t,x\n0,0\n", [], "allowed: the columns time_s, motion_m"),
        ("time_s,motion_m\n0,a\n", [], "line 2 has 'a'; allowed: finite numbers"),
        ("time_s,motion_m\n0,1\n1,2\n", [], "record.csv: the record has 2 times"),
        ("time_s,motion_m\n0,1\n1,2\n2,3,4\n", [], "line 4 has 3 columns; allowed: 2"),
        ("time_s,motion_m\n0,1\n1,nan\n", [], "line 3 has 'nan'"),
        ("# a\ntime_s,motion_m\n0,1\n1,2\n4,1\n5,2\n6,3\n7,3\n", [], "line 5: the time goes from 1 to 4 s,"),
        (
            "time_s,motion_m\n0,1\n1,2\n1,1\n2,2\n",
            [],
            "line 4: the time stays at 1 s; allowed: increasing times at equal steps; sort",
        ),
        ("time_s\n0\n1\n", [], "has the columns time_s; allowed: the columns time_s, motion_m"),
        ("0,1\n1,2\n", [], "no column names in its first row"),
        ("", [], "record.csv has no rows"),
        ("time_s,motion_m\n0,1\n1,2\n", ["--mass", "-1"], "mass is -1000 kg; allowed: above 0"),
        ("time_s,motion_m\n0,1\n1,2\n", ["--plot", "f.txt"], "has the suffix '.txt'"),
    ],
)
def test_a_wrong_record_is_one_line_and_status_2(text, flags, says, tmp_path, capsys):
    path = tmp_path / "record.csv"
    path.write_text(text)
    assert cli.main(["damping", str(path), *flags]) == 2
    told = capsys.readouterr()
    assert says in told.err and told.err.count("\n") == 1 and not told.out


def test_a_decay_by_its_equation_of_motion_has_its_coefficients_and_its_extinction(tmp_path):
    """ẍ + β₁ẋ + β₂ẋ|ẋ| + Ω²x = 0 by Runge and Kutta; a half cycle of amplitude X takes (π/2)(β₁/Ω) X + (4/3) β₂ X²
    (Froude 1874: energies π/2 β₁ΩX² and 4/3 β₂Ω²X³ of ½·2 Ω²XΔX)"""
    linear, quadratic, x, v, h = 0.008, 0.12, 1.5, 0.0, 0.05
    record = []

    def rate(x, v):
        return v, -linear * v - quadratic * v * abs(v) - OMEGA**2 * x

    for _ in range(8001):
        record.append(x)
        k1 = rate(x, v)
        k2 = rate(x + h / 2 * k1[0], v + h / 2 * k1[1])
        k3 = rate(x + h / 2 * k2[0], v + h / 2 * k2[1])
        k4 = rate(x + h * k3[0], v + h * k3[1])
        x += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
        v += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
    path = written(tmp_path / "decay.csv", time_s=T, motion_m=np.array(record)[:-1:20])
    rows = hakobune.damping(path, mass=2e6)
    assert [rows["B1_over_M"], rows["B2_over_M"]] == pytest.approx([linear, quadratic], rel=0.01)
    assert [rows["B1"], rows["B2"]] == pytest.approx([2e6 * linear, 2e6 * quadratic], rel=0.01)
    assert rows["a"] == pytest.approx(np.pi / 2 * linear / OMEGA, rel=0.1)
    assert rows["b"] == pytest.approx(4 / 3 * quadratic, rel=0.1)
    assert rows["period"] == pytest.approx(50.0, rel=1e-3) and rows["left"] < 1e-3


def test_linear_dampings_of_a_forced_oscillation_take_its_energy_or_its_largest_force():
    """B₁ + (8/3π) B₂ v and B₁ + B₂ v, v = aω the largest velocity"""
    v = 3.0 * OMEGA * np.cos(OMEGA * T)
    force = 1500 * 3.0 * OMEGA**2 * np.sin(OMEGA * T) - 40.0 * v - 25.0 * v * np.abs(v)
    columns = {"time_s": T, "motion_m": 3.0 * np.sin(OMEGA * T), "force_kN": force}
    rows, most = hakobune.damping(columns), 3.0 * OMEGA
    assert [rows["amplitude"], rows["period"]] == pytest.approx([3.0, 50.0], rel=1e-3)
    assert rows["linear.same_energy"] == pytest.approx(40e3 + 8 / (3 * np.pi) * 25e3 * most, rel=1e-3)
    assert rows["linear.same_force"] == pytest.approx(40e3 + 25e3 * most, rel=1e-3)
    assert rows["left"] < 1e-3


def test_damping_of_a_model_is_told_in_newtons(tmp_path, capsys):
    """A millionth of the forces: 0.04 N s/m"""
    v = 3.0 * OMEGA * np.cos(OMEGA * T)
    force = 1e-6 * (1500 * 3.0 * OMEGA**2 * np.sin(OMEGA * T) - 40.0 * v)
    path = written(tmp_path / "model.csv", time_s=T, motion_m=3.0 * np.sin(OMEGA * T), force_kN=force)
    assert cli.main(["damping", path]) == 0
    shown = capsys.readouterr().out
    assert "0.04 │ N s/m" in shown and "1.5 │ kg" in shown


def rolled(inertia, ratio, omega):
    """A roll decay from 10° of a body that is damped by `ratio` of critical in all"""
    t = np.arange(0.0, 120.0, 0.1)
    x = 10.0 * np.exp(-ratio * omega * t) * np.cos(omega * np.sqrt(1 - ratio**2) * t)
    return {"time_s": t, "motion_deg": x}, 2 * ratio * omega * inertia


ADDED = 1.2e10 * (1.5 + 0.2 * 0.6 + 0.5 * 0.6 * 0.2)  # kg m² of the made-up body in roll: I + A + ½ω dA/dω at 0.6 rad/s


def of_body(**given):
    return SimpleNamespace(
        bodies_reader=made_up_body(stiffness=np.diag([0, 0, 5e7, 0.36 * 1.944e10, 4e10, 0]), **given)
    )


def test_keys_have_the_damping_without_that_of_the_waves():
    """A study adds the radiation damping of its database: of the made-up body (0.01 + 0.02 ω) I_roll"""
    record, B1 = rolled(ADDED, 0.04, 0.6)
    waves = (0.01 + 0.02 * 0.6) * 1.2e10
    rows = hakobune.damping(record, database=of_body(), motion="roll")
    assert rows["mass"] == pytest.approx(ADDED, rel=1e-3)
    assert rows["B1.waves"] == pytest.approx(waves, rel=1e-3) and rows["B1"] == pytest.approx(B1, rel=2e-3)
    assert rows["B1.rest"] == pytest.approx(B1 - waves, rel=3e-3) and rows.quantity("B1.rest").unit == "N m s"
    said = " ".join(rows.notes)
    assert f"linear_damping = {{ roll = {rows['B1.rest'] / 1e3:.4g} }}" in said and "whichever" not in said
    assert f"less the radiation damping of the database, {rows['B1.waves'] / 1e3:.4g}" in said
    assert "the waves alone damp more" not in said and "apart" not in said


def test_waves_that_damp_more_than_the_record_leave_nothing():
    record, _ = rolled(1.5e9, 0.002, 0.6)
    rows = hakobune.damping(record, database=of_body(), motion="roll")
    assert rows["B1.rest"] == 0.0
    assert "linear_damping = { roll = 0 }" in " ".join(rows.notes)
    assert "the waves alone damp more than the record, so that 0 is left" in " ".join(rows.notes)


def test_a_roll_decay_of_a_body_that_sways_freely_has_the_damping_that_was_put_into_it():
    """(M + A) ẍ + (B + b) ẋ + C x = 0 of all six motions by the exponential of its matrix, released with roll alone
    displaced; B of roll about the origin alone is three times that of the decay"""
    from scipy.linalg import expm

    C, b = np.diag([0, 0, 5e7, 8e9, 4e10, 0]), 2e8
    A, B = 0.6 * np.diag(np.diagonal(INERTIA)), 0.02 * np.diag(np.diagonal(INERTIA))
    A[1, 3] = A[3, 1] = -2.5e8
    B[1, 1], B[3, 3], B[1, 3], B[3, 1] = 1e7, 5e8, -6.5e7, -6.5e7
    body = made_up_body(stiffness=C, added_mass=np.array([A] * 29), radiation_damping=np.array([B] * 29))
    total = B + np.diag([0, 0, 0, b, 0, 0])
    mass = np.linalg.inv(INERTIA + A)
    step = expm(0.2 * np.block([[np.zeros((6, 6)), np.eye(6)], [-mass @ C, -mass @ total]]))
    states = [np.eye(12)[3]]
    for _ in range(700):
        states.append(step @ states[-1])
    record = {"time_s": 0.2 * np.arange(601), "motion_deg": np.array(states)[100:, 3] * 10}  # after the first swings
    rows = hakobune.damping(record, database=SimpleNamespace(bodies_reader=body), motion="roll")
    assert rows["B1.rest"] == pytest.approx(b, rel=0.01)
    assert rows["B1.waves"] < B[3, 3] / 2
    assert rows["B1"] == pytest.approx(rows["B1.waves"] + b, rel=0.02)


def test_mass_beside_a_database_is_compared_with_that_of_the_database():
    record, _ = rolled(ADDED, 0.04, 0.6)
    with pytest.raises(ValueError, match=r"\(kg given as t\?\); roll of this database has 201600"):
        hakobune.damping(record, mass=1e3 * ADDED, database=of_body(), motion="roll")
    notes = " ".join(hakobune.damping(record, mass=1.3 * ADDED, database=of_body(), motion="roll").notes)
    assert "B1 and B2 are computed with the mass of the database" in notes
    soft = SimpleNamespace(bodies_reader=made_up_body())
    assert "roll of the free body in the database has a period of about" in " ".join(
        hakobune.damping(rolled(ADDED, 0.04, 0.5)[0], database=soft, motion="roll").notes
    )
    none = SimpleNamespace(bodies_reader=made_up_body(inertia=None))
    with pytest.raises(ValueError, match="no inertia of the body"):
        hakobune.damping(record, database=none, motion="roll")


def test_keys_without_a_database_say_that_they_contain_the_waves():
    record, _ = rolled(1.5e10, 0.04, 0.6)
    said = " ".join(hakobune.damping(record, mass=1.5e10).notes)
    assert "B1 contains the damping by the waves" in said and "--database and --motion" in said
    assert "contains" not in " ".join(hakobune.damping(record).notes)  # no keys, no warning


@pytest.mark.parametrize(
    ("mass", "motion", "said"),
    [(1.5e10, None, "motion is missing"), (1.5e10, "heave", "roll, pitch, yaw")],
)
def test_a_database_needs_the_recorded_motion(mass, motion, said):
    record, _ = rolled(1.5e10, 0.04, 0.6)
    with pytest.raises(ValueError, match=said):
        hakobune.damping(record, mass=mass, database=SimpleNamespace(bodies_reader=made_up_body()), motion=motion)
