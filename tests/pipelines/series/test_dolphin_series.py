"""`hakobune series dolphin`: one floater in one depth of water, its rows, statements and chart."""

import msgspec
import pytest

from bem.database import open_database
from pipelines import cli
from pipelines.series import dolphin
from pipelines.solve import run as solving


@pytest.fixture(scope="module")
def rows(tmp_path_factory):
    path = tmp_path_factory.mktemp("series") / "A.h5"
    solving.solve(msgspec.structs.replace(dolphin.scene_of("A", 20.0), tolerance=0.05), path)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(dolphin, "COUNTS", (1, 3))
        patch.setattr(dolphin, "HEIGHTS", (2.0,))
        return dolphin.rows_of("A", 20.0, open_database(path))


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


def test_flags_of_another_series_are_refused(capsys):
    assert cli.main(["series", "dolphin", "--only", "A1"]) == 2
    assert "--only is given with dolphin; allowed: with single-point" in capsys.readouterr().err
