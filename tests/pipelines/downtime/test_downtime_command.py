"""`hakobune downtime` as a person runs it, on a small database of the series box and a year of made-up hours."""

import numpy as np
import pytest
from result_views import check_views

import hakobune
from hakobune.mooring.downtime.every_hour import Shape, moments_of_hours, response_of
from hakobune.mooring.downtime.hindcast import WaveHours
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.response.points import Point, transfer_functions
from hakobune.mooring.response.sea_state import linear_response
from hakobune.pipelines.cli import main
from hakobune.pipelines.downtime.pictures import draw
from hakobune.pipelines.downtime.report import page_of

WORDS = "box --length 100 --beam 50 --draft 10 --depth 20 --panels 60 --gyration 15.55,29.44,32.28"
STUDY = """
[hindcast]
file = "hours.csv"
x_axis_compass_deg = 90.0
[[hindcast.waves]]
height = "hs"
peak_period = "tp"
direction_from = "dir"
[body]
damping_ratio = { roll = 0.05 }
[[points]]
name = "bow"
position = [50.0, 0.0, 10.0]
clearance = 10.0
[keel]
tide = 0.5
[[operations]]
name = "cranes"
limits = [{ quantity = "heave", at_most = 0.6, statistic = "significant" }, { quantity = "roll", at_most = 3.0 }]
[[operations]]
name = "gangway"
allowed_hours = 10.0
limits = [{ quantity = "bow acceleration z", at_most = 0.3 }, { quantity = "under-keel clearance", at_least = 8.0 }]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("downtime")
    words = [*WORDS.split(), "--omega", "0.25:1.05:9", "--heading", "0,30,60,90", "--output", str(place / "box.h5")]
    assert main(words) == 0
    rng = np.random.default_rng(2)
    time = np.datetime64("2014-01-01T00", "h") + 12 * np.arange(5 * 731)
    n = len(time)
    columns = time, rng.lognormal(0, 0.4, n), rng.uniform(8, 14, n), rng.uniform(0, 360, n)
    lines = [f"{t},{h:.2f},{p:.1f},{d:.0f}" for t, h, p, d in zip(*columns, strict=True)]
    (place / "hours.csv").write_text("\n".join(["time,hs [m],tp [s],dir [deg]", *lines]))
    (place / "study.toml").write_text(STUDY)
    return place


def test_the_command_the_function_and_their_views_say_the_same(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    made = hakobune.downtime("study.toml", "box.h5")
    assert made.status == 1 and "gangway is down" in made.fails[0] and "limit 10 h" in made.fails[0]
    check_views(made, ["downtime", "study.toml", "--database", "box.h5"], folder / "whole.h5", capsys)
    hours = made["downtime.hours"]
    np.testing.assert_allclose(hours, made["sector.hours"].sum(axis=0))
    used, counts = made["hour.used"], 8766 / (5 * 731)
    np.testing.assert_allclose(
        hours, [counts * np.any(used[:, i] > 1, axis=1).sum() for i in ([0, 1], [2, 3])], rtol=1e-6
    )
    limiting = made["limiting.height"]
    assert limiting.shape == (24, 36, 2) and np.nanmin(limiting) > 0
    page, picture = folder / "p.html", folder / "p.png"
    draw(made, picture)
    page.write_text(page_of(made, STUDY))
    assert page.read_text().count("<img") == 7 and picture.stat().st_size > 50_000


def test_an_hour_of_many_is_that_hour_alone(folder):
    """At frequencies of the body, the direction of the hour itself between those of the ring"""
    body = hakobune.open_database(folder / "box.h5").reader.floating()
    points, beta = [Point("bow", (50.0, 0.0, 10.0))], 0.7312
    response = response_of(body, points, ("heave", "pitch", "bow acceleration z"))
    waves = WaveHours(np.array([1.7]), np.array([9.3]), np.array([beta]))
    m0, m2 = moments_of_hours(response, Shape("jonswap", "peak_period"), waves)
    transfer = transfer_functions(body, response.omega, np.array([beta]), points)
    _, alone = linear_response(Sea(jonswap(1.7, peak_period=9.3), beta), transfer, np.ones(1))
    columns = [transfer.names.index(name) for name in response.names]
    np.testing.assert_allclose(m0[0], alone.m0[columns], rtol=1e-6)
    np.testing.assert_allclose(m2[0], alone.m2[columns], rtol=1e-6)


def test_the_sea_at_the_limit_is_at_the_limit(folder, monkeypatch):
    """An hour of the limiting height uses all of what an operation can bear"""
    monkeypatch.chdir(folder)
    study = STUDY.replace("hours.csv", "limit.csv")
    made = hakobune.downtime("study.toml", "box.h5")
    periods, directions = made.labels["period"].values, made.labels["comes_from"].values
    height = made["limiting.height"][12, :30, 1]
    lines = [f"2020-01-{1 + i // 24:02}T{i % 24:02}:00,{h:.8f},{periods[12]:.10f},{d:.0f}"
             for i, (h, d) in enumerate(zip(height, directions[:30], strict=True))]  # fmt: skip
    (folder / "limit.csv").write_text("\n".join(["time,hs,tp,dir", *lines]))
    (folder / "limit.toml").write_text(study)
    used = hakobune.downtime("limit.toml", "box.h5")["hour.used"][:, 2:].max(axis=1)
    np.testing.assert_allclose(used, 1.0, rtol=1e-5)
