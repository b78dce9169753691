"""What the report of a design says of its body and the checks of its databases, from numbers that are made up."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.design.report import _body_words, _checks, _levels, _whole
from hakobune.pipelines.design.report_words import _place, _place_words


def test_every_check_that_fails_is_told_with_its_number_and_limit(monkeypatch):
    checks = [
        SimpleNamespace(name="energy", passed=False, largest=0.034, omega=0.512, limit=0.01),
        SimpleNamespace(name="Haskind", passed=True, largest=0.001, omega=0.5, limit=0.01),
        SimpleNamespace(name="residual", passed=False, largest=2e-3, omega=1.25, limit=1e-3),
    ]
    monkeypatch.setattr("hakobune.bem.database.open_database", lambda path: path)
    monkeypatch.setattr("hakobune.pipelines.solve.report.checked", lambda db: checks if db == "a.h5" else checks[1:2])
    told = list(_checks({"mean": "a.h5", "high": "b.h5"}))
    assert [one["text"] for one in told if one["css"] == "fails"] == [
        "mean: energy is 0.034 at ω 0.512 rad/s; limit 0.01",
        "mean: residual is 0.002 at ω 1.25 rad/s; limit 0.001",
    ]
    assert told[-1]["css"] == "source"


@pytest.mark.parametrize("scene, css", [
    ("panels = 2500", "source"), ('[[bodies]]\nshape = "mesh"', "source"), ("tolerance = 0.01", "fails"), ("", "fails"),
])  # fmt: skip
@pytest.mark.parametrize("name", ["estimated_error", "damping", "energy"])
def test_an_estimated_error_without_a_tolerance_that_was_asked_for_is_no_failure(monkeypatch, scene, css, name):
    check = SimpleNamespace(name=name, passed=False, largest=0.017, omega=0.918, limit=0.01)
    monkeypatch.setattr(
        "hakobune.bem.database.open_database", lambda path: SimpleNamespace(attributes={"scene": scene})
    )
    monkeypatch.setattr("hakobune.pipelines.solve.report.checked", lambda db: [check])
    told = next(iter(_checks({"mean": "a.h5"})))
    assert told["css"] == (css if name != "energy" else "fails")  # a law holds with any number of panels
    assert told["text"].endswith("no tolerance was asked for" if told["css"] == "source" else "rad/s; limit 0.01")


def test_a_body_is_told_in_tonnes_metres_and_seconds():
    """A box of 100 × 50 × 10 m displaces 1025 · 50 000 kg = 51 250 t; ω from 0.25π to 0.5π is 4 to 8 s"""
    db = SimpleNamespace(
        dimensions={"length": 100.0, "beam": 50.0, "draft": 10.0}, density=1025.0, displaced_volume=50_000.0,
        center_of_mass=(1.0, -2.0, 0.5), omega=np.array([0.25, 0.3, 0.5]) * np.pi, wave_direction=np.zeros(5),
        mesh=SimpleNamespace(total=244), bodies=(),
    )  # fmt: skip
    assert _body_words(db) == (
        "length 100 m, beam 50 m, draft 10 m; displacement 51 250 t, centre of gravity 1, -2, 0.5 m (z up from the "
        "water). 244 panels; 3 periods from 4 to 8 s, 5 headings."
    )
    assert _body_words(SimpleNamespace(**vars(db) | {"dimensions": {}})).startswith("A body from a mesh file; ")
    assert (_whole(1234567.0), _whole(999.4)) == ("1 235 000", "999")


def test_a_page_at_model_scale_has_three_digits_of_displacement_places_and_offsets():
    """51 250 t/70³, lines of 310 m/70 from a depth of 50 m/70, an offset of 2.5 m/70 with 4 m/70 of excursion"""
    assert _whole(51250 / 70**3) == "0.149"
    assert _place([-310 / 70, 20 / 70, -50 / 70]) == "-4.43, 0.286, -0.714"
    assert _place([-310.04, 1e-15, -50.0]) == "-310, 0, -50"
    row = {"x_m": 1.5 / 70, "y_m": 2.0 / 70, "yaw_deg": 12.345, "excursion_m": 4.0 / 70}
    assert _place_words(row) == ["0.0357", "12.35", "0.0571"]
    assert _place_words(row | {"x_m": 0.0, "y_m": 0.0, "excursion_m": np.nan}) == ["0.00", "12.35", "–"]


def test_levels_are_told_as_depths_of_water_over_the_bed():
    """20 m, and 21.5 m at high water"""
    project = SimpleNamespace(level={"mean": 0.0, "high": 1.5}.get)
    read = SimpleNamespace(study={"water": {"depth": 20.0}}, project=project)
    found = list(_levels(read, {"mean": None, "high": "/a/out/databases/high.h5"}, "/a/out"))
    assert found == [
        {"name": "mean", "depth": "20", "link": ""}, {"name": "high", "depth": "21.5", "link": "databases/high.h5"}
    ]  # fmt: skip
