"""`hakobune series dolphin`: one floater in one depth of water, its rows and statements, one simulated."""

import msgspec
import pytest

from bem.database import open_database
from mooring.dolphins.design_spectrum import LARGEST
from pipelines import cli
from pipelines.series import dolphin
from pipelines.series.dolphin_simulated import printed_rows, simulated_rows, statements, table_of
from pipelines.solve import run as solving


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


def test_flags_of_another_series_are_refused(capsys):
    assert cli.main(["series", "dolphin", "--only", "A1"]) == 2
    assert "--only is given with dolphin; allowed: with single-point" in capsys.readouterr().err
