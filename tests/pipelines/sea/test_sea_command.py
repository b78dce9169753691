"""`hakobune sea` as a person runs it."""

import numpy as np
import pytest

from hakobune.mooring.environment.spectra import issc, read_spectrum
from hakobune.mooring.environment.wave_records import read_record
from hakobune.pipelines.cli import main

SEA = ["sea", "--height", "3", "--mean-period", "8"]


def test_a_spectrum_is_told_with_every_moment_and_period(capsys):
    assert main(SEA) == 0
    said = capsys.readouterr().out
    spectrum = issc(3, mean_period=8)
    for value in (spectrum.moment(-1), spectrum.moment(2), spectrum.T02, spectrum.Te, spectrum.Tp, 3.0032):
        assert f"{value:.4g}" in said


def test_a_record_is_written_read_again_and_has_its_spectrum(tmp_path, capsys):
    waves, made, found = (tmp_path / name for name in ("waves.csv", "made.csv", "found.csv"))
    record = ["--duration", "5400", "--step", "0.5", "--seed", "3", "--point", "100,-20", "--depth", "30"]
    spread = ["--direction", "45", "--spreading", "cosine:4"]
    assert main([*SEA, "--record", str(waves), *record, *spread, "--output", str(made)]) == 0
    assert main(["sea", str(waves), "--output", str(found), "--plot", str(tmp_path / "found.png")]) == 0
    assert len(read_record(waves).elevation) == 10800
    assert (tmp_path / "found.png").stat().st_size > 10_000
    # an hour and a half holds the energy to 3 %; the rows written leave out 1e-4 of it
    assert abs(read_spectrum(found).moment(0) / 0.5625 - 1) < 0.03
    assert abs(read_spectrum(made).moment(0) / 0.5625 - 1) < 2e-4
    low, high = np.loadtxt(found, delimiter=",", comments="#", skiprows=3, usecols=(2, 3)).T
    assert np.all(low < high)
    assert "waves" in capsys.readouterr().out


def test_a_table_that_was_written_is_taken_as_a_spectrum(tmp_path, capsys):
    assert main([*SEA, "--output", str(tmp_path / "a.csv")]) == 0
    assert main(["sea", "--table", str(tmp_path / "a.csv"), "--plot", str(tmp_path / "a.svg")]) == 0
    told = capsys.readouterr()
    assert "10.38" in told.out.split("a.csv")[-1] and "warning" not in told.out + told.err
    assert "m² s/rad" in (tmp_path / "a.svg").read_text(encoding="utf-8")


def test_the_same_seed_writes_the_same_file(tmp_path):
    for name, seed in (("a.csv", "4"), ("b.csv", "4"), ("c.csv", "5")):
        assert main([*SEA, "--record", str(tmp_path / name), "--duration", "600", "--seed", seed]) == 0
    a, b, c = ((tmp_path / f"{name}.csv").read_text(encoding="utf-8") for name in "abc")
    assert a == b and a != c


def test_steps_too_long_for_the_waves_fail(tmp_path, capsys):
    assert main([*SEA, "--record", str(tmp_path / "a.csv"), "--step", "3"]) == 1
    assert "FAILS: the step of 3 s is longer than half the period of" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["sea"], "no sea is given"),
        (["sea", "--height", "3"], "no period is given"),
        (["sea", "--height", "-3", "--mean-period", "8"], "wave height is -3 m; allowed: above 0"),
        ([*SEA, "--peak-period", "9"], "mean_period and peak_period are given"),
        ([*SEA, "--gamma", "2"], "--gamma is given for issc"),
        ([*SEA, "--spectrum", "pierson"], "--spectrum is 'pierson'; allowed: issc"),
        ([*SEA, "--duration", "100"], "--duration has no effect, no --record is given"),
        ([*SEA, "--segment", "100"], "--segment has no effect, no record file is given"),
        (["sea", "--wind-speed", "20"], "--fetch is missing"),
        (["sea", "--wind-speed", "20", "--fetch", "1e5", "--height", "3"], "--height has no effect"),
        ([*SEA, "--record", "r.csv", "--seed", "1.5"], "--seed is '1.5'; allowed: a whole number"),
        ([*SEA, "--record", "r.csv", "--point", "3"], "--point is '3'; allowed: two numbers x,y"),
        ([*SEA, "--record", "r.csv", "--spreading", "cos"], "--spreading is 'cos'; allowed: cosine:N"),
        ([*SEA, "--record", "r.csv", "--duration", "-1"], "--duration is -1"),
        ([*SEA, "--record", "r.csv", "--output", "r.csv"], "r.csv is given as the name of two files"),
        ([*SEA, "--record", "r.csv", "--components", "0"], "--components is '0'; allowed: a whole number from 1"),
        ([*SEA, "--record", "r.csv", "--components", "2.5"], "--components is '2.5'; allowed: a whole number from 1"),
        (
            [*SEA, "--record", "r.csv", "--components", "100000000"],
            "100000000 components at 7200 times need about 613 GB",
        ),
        (["sea", "--table", "s.csv", "--output", "s.csv"], "s.csv is given as the name of two files"),
        ([*SEA, "--plot", "a.txt"], "suffix '.txt'"),
        (["sea", "none.csv"], "none.csv does not exist"),
        (["sea", "none.csv", "--height", "3"], "--height has no effect, a record file is given"),
    ],
)
def test_a_fault_is_one_line_and_leaves_no_file(words, said, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(words) == 2
    error = capsys.readouterr().err
    assert said in error and error.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_a_column_that_is_not_there_is_named_beside_those_that_are(tmp_path, capsys):
    waves = tmp_path / "waves.csv"
    waves.write_text("time_s,elevation_m\n0,1\n1,-1\n", encoding="utf-8")
    assert main(["sea", str(waves), "--column", "foo"]) == 2
    assert "waves.csv has no column 'foo'; allowed: time_s, elevation_m" in capsys.readouterr().err
    waves.write_text("0,1\n1,-1\n", encoding="utf-8")
    assert main(["sea", str(waves), "--column", "foo"]) == 2
    assert "column is 'foo', " in capsys.readouterr().err


def test_a_table_without_its_density_is_told_which_columns_it_needs(tmp_path, capsys):
    table = tmp_path / "table.csv"
    table.write_text("omega_rad_s,S\n0.5,1\n1,2\n", encoding="utf-8")
    assert main(["sea", "--table", str(table)]) == 2
    assert "has the columns omega_rad_s,S; allowed columns: omega_rad_s,density_m2_s_rad or" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words, status, said",
    [
        ("--spectrum jonswap --wind-speed 5 --fetch 1e7", 2, "beyond 5.497e+04 m the sea of a wind of 5 m/s is fully"),
        ("--height 25 --peak-period 20 --depth 20", 2, "single waves break at 16.66 m in 20 m of water"),
        ("--height 13 --peak-period 20 --depth 20", 0, "13 m is 0.65 of the water depth 20 m"),
        (
            "--height 3 --mean-period 8 --record r.csv --components 3",
            0,
            "3 components are too few for a record that resolves",
        ),
        (
            "--spectrum tma --height 3 --peak-period 8",
            2,
            "tma needs a finite water depth; give the depth, or use jonswap",
        ),
    ],
)
def test_waves_that_cannot_be_are_refused_or_warned_of(tmp_path, monkeypatch, capsys, words, status, said):
    monkeypatch.chdir(tmp_path)
    assert main(["sea", *words.split()]) == status
    shown = capsys.readouterr()
    assert said in " ".join((shown.out + shown.err).split())
