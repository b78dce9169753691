"""What `hakobune simulate` says, judges and draws of runs that are sines: each message on both sides of its limit."""

import math
import re
from types import SimpleNamespace

import numpy as np
import pytest
from test_simulate import folder, plan, simulate  # noqa: F401 - a fixture among them

from hakobune.mooring.motion.statistics import windows
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.simulate import berth, findings, over_runs, pictures
from hakobune.pipelines.simulate import file as stored
from hakobune.pipelines.simulate.file import SUMMARY, opened
from hakobune.pipelines.simulate.pictures import draw, spectrum
from hakobune.pipelines.simulate.study import MISSED, MOST_MISSED, _outside

OMEGA = 0.6  # rad/s, of the oscillator; its waves have an amplitude w of about 1 m, motion j 0.01 (j + 1) w


def made_up(
    duration=600.0,
    depth=20.0,
    length=100.0,
    draft=10.0,
    slow=0.0,
    wave=0.1,
    periods=(),
    mean_period=np.nan,
    spectral=(),
):
    """A file of a run with such attributes; slow, wave and spectral σ, and periods, s, of surge, sway, yaw"""
    row = [slow if key == "slow" else wave if key == "wave" else 0.0 for key in SUMMARY]
    names = np.array(["surge", "sway", "yaw"])
    made = {"quantity": SimpleNamespace(asstr=lambda: names), "summary": np.array([row] * 3),
            "statistics": np.zeros((1, 3, 12)), "stored": np.zeros(1)}  # fmt: skip

    class File(dict):
        pass

    file = File(made)
    unknown = [np.nan] * 3
    file.attrs = {
        "duration": duration, "water_depth": depth, "hull": [length, 50.0, draft], "mean_period": mean_period,
        "moored_period": [*periods, *unknown][:3], "spectral_slow": [*spectral, *unknown][:3],
    }  # fmt: skip
    return file


@pytest.fixture
def quiet(monkeypatch):
    """Findings without those on rare largest values, of runs that differ"""
    monkeypatch.setattr(findings, "rare_findings", lambda file: ())
    monkeypatch.setattr(findings, "differ", lambda file: True)


@pytest.mark.parametrize("duration, told", [(1010.0, False), (990.0, True)])
def test_a_run_shorter_than_ten_of_the_slowest_periods_is_told_with_how_uncertain_it_is(quiet, duration, told):
    """σ of N independent halves of a period is known to 1/√(2N), N = duration over period"""
    said = [line for line in findings.findings(made_up(duration, periods=[100.0])) if "covers" in line]
    assert bool(said) is told
    if told:
        share = 100 / math.sqrt(2 * duration / 100)
        assert f"(100 s), recommended 10: σ of this motion is uncertain by about {share:.0f} %; " in said[0]
        assert said[0].endswith(f"uncertain by about {share:.0f} %; simulate 1e+03 s")
        assert "a run of 990 s covers 9.9 of the slowest natural periods (100 s), recommended 10" in said[0]


@pytest.mark.parametrize("duration, periods, told", [
    (20.0, [48.0, 12.0, 11.0], "a run of 20 s covers 0.42 of the slowest natural periods (48 s), recommended 10"),
    (481.0, [48.0, 12.0, 11.0], None), (481.0, [np.inf, 5e4, 48.0], None), (20.0, [np.nan] * 3, None),
])  # fmt: skip
def test_a_run_at_a_berth_is_as_long_as_its_ropes_and_fenders_ask(quiet, duration, periods, told):
    file = made_up(duration)
    file.attrs["natural_period"] = np.array(periods)
    said = [line for line in findings.findings(file) if "covers" in line]
    assert len(said) == (told is not None)
    assert not told or said[0].startswith(told)


@pytest.mark.parametrize("depth, words", [
    (20.0, "in up to 20 m of water use the simulation"), (20.1, "between 20 and 40 m of water use the larger of "
    "the two"),
    (39.9, "between 20 and 40 m of water use the larger of the two"), (40.0, "in 40 m of water or more, the "
    "simplified method is also on the safe side"),
])  # fmt: skip
def test_the_method_follows_the_depth_as_in_section_5_5_3(quiet, depth, words):
    """SR179 report (1982): up to 20 m the simulation, from 40 m the simplified method, between the larger of both"""
    (said,) = findings.findings(made_up(1e6, depth, periods=[80.0, 8.0], mean_period=8.0))
    assert words in said and f"depth over draft {depth / 10:.3g}; natural over wave period: surge 10, sway 1;" in said


@pytest.mark.parametrize("length, told", [(49.9, True), (50.1, False)])
def test_limits_in_metres_are_of_large_floaters(quiet, length, told):
    (said,) = findings.findings(made_up(1e6, 20.0, length, periods=[80.0], mean_period=8.0))
    assert (
        "report's limits of water depth are for floaters of 100 to 200 m length, not for this floater" in said
    ) is told


@pytest.mark.parametrize("slow, wave, told", [
    (0.201, 0.1, True), (0.199, 0.1, False),  # twice the linear answer of 0.1
    (0.3, 0.61, False), (0.3, 0.59, True),  # half of the motion with the waves
])  # fmt: skip
def test_slow_motion_far_beyond_the_linear_answer_is_told(slow, wave, told):
    said = list(findings.slow_findings(made_up(slow=slow, wave=wave, spectral=(0.1, np.nan, 1e3))))
    assert bool(said) is told
    assert not told or said[0].startswith(
        f"slow surge has σ {slow:.3g} m; slow forces on springs as stiff as the lines"
    )


def test_slow_yaw_is_told_in_degrees():
    said = list(findings.slow_findings(made_up(slow=math.radians(3.0), spectral=(np.nan, np.nan, math.radians(1.0)))))
    assert said[0].startswith("slow yaw has σ 3 °") and "mean loads would give 1 °" in said[0]


def test_windows_have_half_the_significant_height_and_the_period_of_their_waves():
    """Surge of 8 s and 2 m, then of 10 s and 1 m; sway is still; yaw of 0.02 rad"""
    t = np.arange(0, 400.0, 0.5)
    surge = np.where(t < 200, 2 * np.sin(2 * np.pi * t / 8), np.sin(2 * np.pi * t / 10)) + 5.0
    motion = np.zeros((len(t) + 1, 6))
    motion[:-1, 0], motion[:-1, 5] = surge, 0.02 * np.sin(2 * np.pi * t / 8)
    motion[-1] = motion[-2]
    found = windows(motion, 0.5, 200.0)
    assert found.start.tolist() == [0.0, 200.0]
    assert found.amplitude[:, 0] == pytest.approx([2.0, 1.0], rel=0.01)
    assert found.period[:, 0] == pytest.approx([8.0, 10.0], rel=0.01)
    assert (found.amplitude[0, 2], found.period[0, 2]) == pytest.approx((0.02, 8.0), rel=0.01)
    assert np.all(np.isnan([found.amplitude[0, 1], found.period[0, 1]]))
    assert len(windows(motion, 0.5, 150.0).start) == 2  # the last 100 s are no whole window
    assert windows(motion, 0.5, 500.0).amplitude.shape == (0, 3)


@pytest.mark.parametrize("length, good", [(2.5, True), (2.4, False), (600.0, True), (601.0, False)])
def test_windows_hold_five_samples_and_lie_within_a_run(length, good):
    asked = SimpleNamespace(settings=SimpleNamespace(step=0.5, duration=600.0), keep_series=1)
    if good:
        berth.check_windows(length, asked)
        return
    with pytest.raises(StudyError, match=rf"--windows is {length:g} s; allowed: 2.5 s to the duration, 600 s"):
        berth.check_windows(length, asked)


@pytest.mark.parametrize("keep, good", [(1, True), (0, False)])
def test_windows_need_a_record(keep, good):
    asked = SimpleNamespace(settings=SimpleNamespace(step=0.5, duration=600.0), keep_series=keep)
    if good:
        berth.check_windows(10.0, asked)
        return
    with pytest.raises(StudyError, match="no record is stored"):
        berth.check_windows(10.0, asked)


@pytest.mark.parametrize("share", [0.9 * MISSED, 1.1 * MISSED, 0.99 * MOST_MISSED, 1.01 * MOST_MISSED])
def test_energy_outside_the_stored_band_is_told_above_one_per_cent_and_refused_above_a_quarter(share):
    """P(ω < x) of an ISSC spectrum is exp(−B/x⁴), with 4B/5 = (2π/Tp)⁴"""
    from hakobune.mooring.environment.spectra import issc

    sea = issc(2.0, peak_period=10.0)
    B = 1.25 * (2 * np.pi / 10.0) ** 4
    low = (B / -math.log(share)) ** 0.25
    omega = np.linspace(low, 60.0, 50)
    if share > MOST_MISSED:
        with pytest.raises(StudyError, match=r"25\.\d % of the wave energy lies outside .* allowed: 25 %; solve"):
            _outside(sea, omega)
    else:
        said = _outside(sea, omega)
        assert bool(said) is (share > MISSED)
        for number in re.findall(r"([\d.]+) %", said[0])[:2] if said else ():  # ISSC prints two digits of its constants
            assert float(number) == pytest.approx(100 * share, abs=0.15)
        assert not said or ("and is not included; solve" in said[0] and f"% below {low:.4g}" in said[0])


SETTINGS = [
    ("duration = 600.0", None), ("duration = 4.0\nstep = 0.5", None),
    ("duration = 3.9\nstep = 0.5", "simulation has 3.9 s; allowed: at least 4 s, 8 samples"),
    ("duration_hours = 0.5", None), ("duration = 600.0\nduration_hours = 1.0", "both are given; give one of"),
    ("seeds = 2", "neither is given; give one of duration"),
    ("duration = 600.0\nseeds = 10000", None), ("duration = 600.0\nseeds = 10001", "there are 10001 seeds"),
    ("duration = 600.0\nseeds = 0", "there are 0 seeds; allowed: 1 to 10000"),
    ("duration = 600.0\nseeds = [0, 3]", None), ("duration = 600.0\nseeds = [-1, 3]", "whole numbers from 0"),
    ("duration = 600.0\nseeds = [3, 3]", "whole numbers from 0, each given once"),
    ("duration = 600.0\nkeep_series = 0", None), ("duration = 600.0\nkeep_series = -1", "keep_series is -1"),
    ("duration = 600.0\ncomponents = 100000", None),
    ("duration = 600.0\ncomponents = 100001", "simulation.components is 100001; allowed: 1 to 100000"),
    ("duration = 1e6\nstep = 0.5\nramp = 0.0", None),
    ("duration = 1000001\nstep = 0.5\nramp = 1.0", "samples; allowed: 2000000; give a longer step"),
]  # fmt: skip


@pytest.mark.parametrize("table, says", SETTINGS)
def test_settings_are_taken_up_to_their_limits(table, says):
    text = f"[simulation]\n{table}\n"
    if says is None:
        plan(text)
        return
    with pytest.raises(StudyError, match=re.escape(says)):
        plan(text)


def test_durations_in_hours_are_seconds_and_seeds_count_from_one():
    made = plan("[simulation]\nduration_hours = 0.5\nseeds = 4\n")
    assert made.settings.duration == 1800.0 and made.seeds == (1, 2, 3, 4)
    assert plan("[simulation]\nduration = 700.0\nseeds = [7, 2]\n").seeds == (7, 2)


@pytest.mark.parametrize("runs, words", [
    (4, "the largest is the largest value in 4 runs; "
        "with 90 % confidence, no more than 44 % of further runs exceed it; run "
        "5 seeds for a"),
    (5, "the median extreme is exceeded by half of such runs, and its interval holds for any distribution of "
        "the largest"),
])  # fmt: skip
def test_five_runs_have_a_median_extreme(folder, runs, words):  # noqa: F811
    """1 − 0.1^(1/n): the largest of four is gone beyond by at most 44 % of runs with a confidence of 90 %"""
    simulate(runs)
    with opened("run.h5") as file:
        said = " ".join(over_runs.notes(file))
    assert words in said
    assert f"{100 * (1 - 0.1 ** (1 / runs)):.2g} % of further runs" in said


def test_records_and_offsets_are_drawn_in_the_units_of_their_axes(folder, pictures):  # noqa: F811
    simulate(1)
    with opened("run.h5") as file:
        assert draw(file, folder / "run.h5")[0] == "run_records.png"
        time, motion = file["time"][()], file["motion"][0].astype(float)
        tension, wave = file["tension"][0].astype(float), file["wave"][0].astype(float)
        fairlead, anchor = file["fairlead"][()], file["anchor"][()]
        names, rest = file["line"].asstr()[()], file.attrs["place_at_rest"][:2]
    records, spectra, offsets, extremes = pictures
    axes = records.axes
    units = ["wave, m", "surge, m", "sway, m", "heave, m", "roll, °", "pitch, °", "yaw, °"]
    assert [one.get_ylabel() for one in axes[:7]] == units
    worst = int(np.argmax(tension.max(axis=0)))
    assert axes[7].get_ylabel() == f"tension, kN\n{names[worst]}" and axes[7].get_xlabel() == "s after the ramp"
    for one, values in ((axes[0], wave), (axes[3], motion[:, 2]), (axes[4], np.degrees(motion[:, 3])),
                        (axes[6], np.degrees(motion[:, 5])), (axes[7], tension[:, worst] / 1e3)):  # fmt: skip
        t, drawn = one.lines[0].get_data()
        assert np.interp(t, time, values) == pytest.approx(drawn, abs=1e-6 * np.abs(values).max())
        assert t[-1] - t[0] == pytest.approx(600.0)
    assert not axes[3].lines[1:] and len(axes[1].lines) == 2  # the slow part of surge, sway and yaw alone
    plan_, curve = offsets.axes
    points = plan_.lines[0].get_xydata()
    assert points[:, 1] == pytest.approx(2 * points[:, 0], rel=1e-4)  # sway is twice the surge
    radius = np.hypot(*(motion[:, :2] - rest).T).max()
    assert plan_.get_title() == f"watch circle of 1 run, radius {radius:.3g} m about rest"
    far = np.array([line.get_xydata()[0] for line in plan_.lines if line.get_label() == "farthest"])
    assert np.hypot(*(far[0] - rest)) == pytest.approx(radius, rel=1e-5)
    away = fairlead[worst, :2] - anchor[worst, :2]
    away /= np.hypot(*away)
    x, pull = curve.lines[0].get_data()
    yaw = motion[:, 5]
    arm = fairlead[worst, :2]
    turned = np.stack([np.cos(yaw) * arm[0] - np.sin(yaw) * arm[1], np.sin(yaw) * arm[0] + np.cos(yaw) * arm[1]], 1)
    offset = (motion[:, :2] + turned - arm) @ away
    assert x == pytest.approx(offset, abs=1e-5) and pull == pytest.approx(tension[:, worst] / 1e3, rel=1e-5)
    assert curve.get_ylabel() == "tension, kN" and "1 run" in curve.get_title()
    assert len(spectra.axes) == 8 and len(extremes.axes) == 2


def test_a_spectrum_of_one_sine_has_its_variance_at_its_frequency():
    """∫ S dω = a²/2 of each of two runs, of 1 and 2 m: their mean 1.25"""
    t = np.arange(0, 2048) * 0.5
    records = np.stack([np.sin(0.5 * t), 2 * np.sin(0.5 * t)])
    omega, density = spectrum(records, 0.5)
    step = omega[1] - omega[0]
    assert density.sum() * step == pytest.approx(1.25, rel=0.02)
    assert omega[np.argmax(density)] == pytest.approx(0.5, abs=step)


def test_spectra_reach_to_all_but_a_hundredth_of_the_waves():
    """Amplitudes of 1 at 1.5 and of 0.2 at 2.6 rad/s, 4 % of the energy; of 0.05, 0.25 %"""
    t = np.arange(0, 4096) * 0.25
    waves = [np.sin(1.5 * t) + a * np.sin(2.6 * t) for a in (0.2, 0.05)]
    assert [pictures._reach(one[None], 0.25) for one in waves] == pytest.approx([2.6, 1.5], abs=0.05)
    assert pictures._reach(np.zeros((2, 64)), 0.25) == 0


def test_a_finding_of_many_runs_is_told_once_with_its_largest_number(monkeypatch):
    """Mean frequencies of the waves of each seed differ; lines of other numbers stay apart"""
    monkeypatch.setattr(stored, "whole_rows", lambda file: slice(None))
    lines = ["damps as waves of 0.965 rad/s do", "damps as waves of 0.966 rad/s do\nline 2 parts at 10.5 s",
             "line 2 parts at 9.5 s\nline 3 parts at 9.5 s"]  # fmt: skip
    file = type("File", (dict,), {"attrs": {"findings_of_all": "of all"}})(
        findings=np.array([line.encode() for line in lines], "S100")
    )
    said = stored.stored_findings(file)
    assert said == ("of all", "damps as waves of 0.966 rad/s do", "line 2 parts at 10.5 s", "line 3 parts at 9.5 s")


@pytest.mark.parametrize(("degrees", "told"), [(14.9, False), (-15.1, True), (31.0, True)])
def test_a_tilt_beyond_linear_theory_is_told_of_each_body(degrees, told):
    """The larger of both ends, of roll and pitch; a yaw of any size turns the hull and is part of the equation"""
    file = made_up()
    names = np.array(["surge", "barge roll", "yaw"])
    rows = [[math.radians(degrees) if key == ("smallest" if degrees < 0 else "largest") else 0.0 for key in SUMMARY]]
    file |= {"quantity": SimpleNamespace(asstr=lambda: names), "summary": np.array(rows * 3)}
    said = list(findings.tilt_findings(file))
    assert said == [
        f"the motion has an amplitude of barge roll {abs(degrees):.3g}°; linear theory is valid up to about 15°, so "
        "this motion is not realistic; give viscous damping ([viscous] of the scene; simulate also takes "
        "simulation.damping_ratio), or use lower waves"
    ] * told  # fmt: skip
