"""`hakobune damping`: its picture, its sums in percent, and what it judges, from both sides of each limit."""

import numpy as np
import pytest

from hakobune.pipelines.cli import main

T = np.arange(0.0, 400.0, 1.0)
OMEGA = 2 * np.pi / 50.0


def written(folder, **columns):
    path = folder / "record.csv"
    np.savetxt(path, np.stack(list(columns.values()), axis=1), delimiter=",", header=",".join(columns), comments="")
    return path


def forced(a=3.0, mass=1500.0, first=40.0, second=25.0, noise=0.0):
    v = a * OMEGA * np.cos(OMEGA * T)
    force = mass * a * OMEGA**2 * np.sin(OMEGA * T) - first * v - second * v * np.abs(v)
    return a * np.sin(OMEGA * T), force + noise


def test_the_picture_of_a_forced_oscillation_has_record_and_fit_in_kilonewtons(tmp_path, asked, pictures):
    motion, force = forced()
    path = written(tmp_path, time_s=T, motion_m=motion, force_kN=force)
    asked("damping", path, "--plot", tmp_path / "p.png")
    (axis,) = pictures[0].axes
    record, fit = axis.lines
    assert (record.get_label(), fit.get_label(), axis.get_xlabel(), axis.get_ylabel()) == (
        "record", "fitted", "time, s", "reaction, kN")  # fmt: skip
    assert record.get_xydata() == pytest.approx(np.stack([T, force - force.mean()], 1), abs=1e-4)
    assert fit.get_ydata() == pytest.approx(force, abs=2e-3 * np.abs(force).max())


def test_the_picture_of_a_decay_has_its_motion(tmp_path, asked, pictures):
    motion = 2.0 * np.exp(-0.04 * OMEGA * T) * np.cos(OMEGA * np.sqrt(1 - 0.04**2) * T)
    (table,), _ = asked("damping", written(tmp_path, time_s=T, motion_m=motion), "--plot", tmp_path / "p.png")
    (axis,) = pictures[0].axes
    assert axis.get_ylabel() == "motion, m"
    for line in axis.lines:
        assert line.get_ydata() == pytest.approx(motion, abs=0.02)
    rows = {row["quantity"]: row for row in table["rows"]}
    # ζ = β₁/2Ω = 4 %; half cycles lose πζ of the amplitude where it is linear
    assert rows["B1/M"]["note"].startswith("4 % of critical") and rows["B1/M"]["unit"] == "1/s"
    assert float(rows["a"]["note"].split()[3]) == pytest.approx(np.pi * 0.04, rel=0.05)
    count, _, _, first, _ = rows["natural period"]["note"].split()
    assert int(count) == pytest.approx(2 * 400 / 50, abs=2) and float(first) <= 2.0


@pytest.mark.parametrize("part, status", [(0.23, 0), (0.28, 1)])
def test_a_record_that_is_left_over_by_more_than_a_quarter_fails(tmp_path, asked, part, status):
    """A second sine that no fit explains, of another period than the motion: r.m.s. part/√(1 + part²)"""
    motion, force = forced(mass=1500.0, first=40.0, second=0.0)
    other = np.sqrt(2) * np.sin(3.7 * OMEGA * T)
    size = force.std()
    path = written(tmp_path, time_s=T, motion_m=motion, force_kN=force + part * size * other)
    (table,), said = asked("damping", path, status=status)
    off = next(row["value"] for row in table["rows"] if row["quantity"] == "force not explained")
    assert off == pytest.approx(100 * part / np.sqrt(1 + part**2), rel=0.06)
    assert ("of the force is left over, limit 25 %; this is no record of a sine" in said) is bool(status)


@pytest.mark.parametrize("sign, status", [(1.0, 0), (-1.0, 1)])
def test_a_force_that_gives_energy_to_the_body_fails(tmp_path, asked, sign, status):
    motion, force = forced(first=sign * 40.0, second=0.0)
    path = written(tmp_path, time_s=T, motion_m=motion, force_kN=force)
    (table,), said = asked("damping", path, status=status)
    same = next(row["value"] for row in table["rows"] if row["quantity"] == "linear damping of the same energy")
    assert same == pytest.approx(sign * 40.0, rel=1e-3)
    assert ("FAILS: the damping is negative, -40 kN s/m of the same energy, limit 0" in said) is bool(status)


def test_a_mass_is_of_a_decay(tmp_path, capsys):
    motion, force = forced()
    path = written(tmp_path, time_s=T, motion_m=motion, force_kN=force)
    assert main(["damping", str(path), "--mass", "10"]) == 2
    assert "--mass is given with force_kN in the record; allowed: of a decay" in capsys.readouterr().err
    assert main(["damping", str(path), "--mass", "0"]) == 2
    assert "--mass is 0; allowed: above 0, finite" in capsys.readouterr().err
