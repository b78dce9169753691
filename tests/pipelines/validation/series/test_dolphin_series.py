"""`hakobune series dolphin`: one floater in one depth of water, its rows and statements, one simulated."""

import csv

import msgspec
import pytest

from hakobune.bem.database import open_database
from hakobune.mooring.dolphins.design_spectrum import LARGEST
from hakobune.pipelines import cli
from hakobune.pipelines.solve import run as solving
from hakobune.pipelines.validation.series import dolphin
from hakobune.pipelines.validation.series.dolphin_simulated import printed_rows, simulated_rows, statements, table_of


@pytest.fixture(scope="module")
def database(tmp_path_factory):
    path = tmp_path_factory.mktemp("series") / "A.h5"
    solving.solve(msgspec.structs.replace(dolphin.scene_of("A", 20.0), tolerance=0.05), path)
    return path


@pytest.fixture(scope="module")
def rows(database):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(dolphin, "COUNTS", (1, 3))
        patch.setattr(dolphin, "HEIGHTS", (2.0,))
        return dolphin.rows_of("A", 20.0, open_database(database))


def test_limits_of_floater_a_are_near_the_reports(rows):
    """0.35 m with one fender on each dolphin, 0.9 m with three; printed without wind, depth and period"""
    limit = {r.fenders: r.limit_m for r in rows if (r.period_s, r.wind_m_s) == (10.0, 25.0)}
    assert limit[1] == pytest.approx(0.35, rel=0.25) and limit[3] == pytest.approx(0.9, rel=0.25)


def test_steady_loads_and_strains_follow_the_weather(rows):
    calm, storm = ([r for r in rows if r.wind_m_s == wind] for wind in (25.0, 50.0))
    for one, other in zip(calm, storm, strict=True):
        assert other.steady_tonf == pytest.approx(4 * one.steady_tonf, rel=1e-9)
        assert other.static_strain > one.static_strain and other.sigma_m == one.sigma_m
        assert other.limit_m <= one.limit_m


def test_a_row_of_the_reports_simulations_stands_as_printed(database):
    """Row 8: σ 0.136 m, mean 0.135 m, 26.4 % of a fender of 2.5 m; the printed period taken for the significant one"""
    (row,) = simulated_rows({("A", 20.0): database}, [8], ["significant"], duration=900.0, seeds=[1])
    assert row.sigma_m == pytest.approx(row.printed_sigma_m, rel=0.25)
    assert row.mean_m == pytest.approx(row.printed_mean_m, rel=0.25)
    assert row.verdict == row.printed_verdict == "stands"
    assert next(statements([row])).startswith("significant: σ within a fifth of the print in ")
    assert table_of([row]).row_count == 1


def test_the_printed_rows_are_consistent():
    for row in printed_rows():
        strain = (float(row["mean_m"]) + LARGEST * float(row["sigma_m"])) / float(row["height_m"])
        assert strain == pytest.approx(float(row["strain"]), abs=3e-3)


def test_a_quay_behind_is_wired_by_the_far_field_and_lowers_the_limits(database, rows, monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(dolphin, "COUNTS", (3,))
    monkeypatch.setattr(dolphin, "HEIGHTS", (1.0,))
    monkeypatch.setattr(dolphin, "DEPTHS", {"A": (20.0,)})
    monkeypatch.setattr(dolphin, "PRINTED", {("A", 3): 0.9})
    monkeypatch.setattr("hakobune.bem.wave_field.before_wall.FEWEST", 50)
    monkeypatch.setattr("hakobune.bem.wave_field.before_wall.MOST", 60)
    (tmp_path / "A_20m_beam.h5").symlink_to(database)
    monkeypatch.setattr("hakobune.pipelines.validation.series.dolphin.whole_database", lambda scene, path, fresh: path)
    assert cli.main(["series", "dolphin", "--quay", "25", "--output", str(tmp_path)]) == 0
    told = capsys.readouterr().out
    assert "quay at y = 50 m: by the far field; 0.039 % of a wave" in told
    table = list(csv.DictReader((tmp_path / "dolphin_quay_25m.csv").open()))
    limits = {(float(r["period_s"]), int(r["fenders"]), float(r["wind_m_s"])): float(r["limit_m"]) for r in table}
    rows = [r for r in rows if r.fenders == 3]
    assert len(table) == len(rows) and (tmp_path / "dolphin_A_quay_25m.png").stat().st_size > 5000
    assert not (tmp_path / "dolphin.csv").exists()
    for r in rows:  # waves that come back at the floater add to those that arrive
        assert limits[r.period_s, r.fenders, r.wind_m_s] < r.limit_m or r.limit_m == 0
    first = next(r for r in rows if (r.wind_m_s, r.period_s) == (25.0, 10.0))
    assert f"{limits[10.0, 3, 25.0]:.2f} for {first.limit_m:.2f} (20 m, 10 s)" in told


@pytest.mark.parametrize("gap", ["3", "-5", "nan", "2000"])
def test_a_quay_too_near_is_refused_before_anything_is_solved(gap, tmp_path, capsys):
    assert cli.main(["series", "dolphin", "--quay", gap, "--output", str(tmp_path / "s")]) == 2
    told = capsys.readouterr().err
    assert "allowed: 20 to 1000 m" in told and told.count("\n") == 1 and not (tmp_path / "s").exists()


def test_flags_of_another_series_are_refused(capsys):
    assert cli.main(["series", "dolphin", "--only", "A1"]) == 2
    assert "--only is given with dolphin; allowed: with single-point" in capsys.readouterr().err
