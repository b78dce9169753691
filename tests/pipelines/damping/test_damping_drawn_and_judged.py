"""`hakobune damping`: its picture, its sums, and what it judges, from both sides of each limit."""

import numpy as np
import pytest

import hakobune

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
    path = written(tmp_path, time_s=T, motion_m=motion)
    asked("damping", path, "--plot", tmp_path / "p.png")
    (axis,) = pictures[0].axes
    assert axis.get_ylabel() == "motion, m"
    for line in axis.lines:
        assert line.get_ydata() == pytest.approx(motion, abs=0.02)
    # ζ = β₁/2Ω = 4 %; half cycles lose πζ of the amplitude where it is linear
    found = hakobune.damping(path)
    assert found["critical"] == pytest.approx(0.04, rel=0.01)
    assert found["B1_over_M"] == pytest.approx(2 * 0.04 * OMEGA, rel=0.01)
    assert found["a.alone"] == pytest.approx(np.pi * 0.04, rel=0.05)
    count, _, _, first, *_ = found.notes[0].split()
    assert int(count) == pytest.approx(2 * 400 / 50, abs=2) and float(first) <= 2.0


@pytest.mark.parametrize("part, status", [(0.23, 0), (0.28, 1)])
def test_a_record_that_is_left_over_by_more_than_a_quarter_fails(part, status):
    """A second sine that no fit explains, of another period than the motion: r.m.s. part/√(1 + part²)"""
    motion, force = forced(mass=1500.0, first=40.0, second=0.0)
    other = np.sqrt(2) * np.sin(3.7 * OMEGA * T)
    size = force.std()
    found = hakobune.damping({"time_s": T, "motion_m": motion, "force_kN": force + part * size * other})
    assert found["left"] == pytest.approx(part / np.sqrt(1 + part**2), rel=0.06)
    assert found.status == status == len(found.fails)
    assert not status or "of the force is not explained, limit 25 %; this is not a record of a sine" in found.fails[0]


@pytest.mark.parametrize("sign, status", [(1.0, 0), (-1.0, 1)])
def test_a_force_that_gives_energy_to_the_body_fails(sign, status):
    motion, force = forced(first=sign * 40.0, second=0.0)
    found = hakobune.damping({"time_s": T, "motion_m": motion, "force_kN": force})
    assert found["linear.same_energy"] == pytest.approx(sign * 40e3, rel=1e-3)
    assert found.status == status == len(found.fails)
    assert not status or "the equivalent damping by energy is negative, -40 kN s/m, limit 0" in found.fails[0]


def test_a_mass_is_of_a_decay():
    motion, force = forced()
    record = {"time_s": T, "motion_m": motion, "force_kN": force}
    with pytest.raises(ValueError, match="mass is given and the record has force_kN; mass is needed for a decay only"):
        hakobune.damping(record, mass=10e3)
    with pytest.raises(ValueError, match="mass is 0 kg; allowed: above 0, finite"):
        hakobune.damping(record, mass=0.0)
