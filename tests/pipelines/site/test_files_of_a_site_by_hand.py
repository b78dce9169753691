"""What `hakobune site` writes and names, with its computation replaced; the words of a load case without lines."""

from types import SimpleNamespace

import pytest

from hakobune.pipelines.design import report_words
from hakobune.pipelines.site import command, report
from hakobune.pipelines.site import result as of_site


@pytest.mark.parametrize("name", ["v.toml", "v.h5", "v.HDF5"])
def test_values_of_a_site_are_a_file_for_studies_with_a_page_or_the_whole_result(monkeypatch, tmp_path, capsys, name):
    from hakobune.pipelines.common import outputs
    from hakobune.pipelines.results import output, tables

    asked = []
    made = SimpleNamespace(detail=("study", "text", "values"), write=lambda path: asked.append(("write", path)))
    monkeypatch.setattr(of_site, "site", lambda site: asked.append(site) or made)
    monkeypatch.setattr(report, "values_text", lambda study, values: f"values of {study} {values}")
    monkeypatch.setattr(report, "page", lambda study, values, text: f"page of {study} {values} {text}")
    monkeypatch.setattr(tables, "printed", lambda result: 3)
    monkeypatch.setattr(output, "check_result", lambda *given: asked.append(("result", *given)))
    monkeypatch.setattr(outputs, "check_output", lambda *given: asked.append(("output", *given)))
    site, place = tmp_path / "s.toml", tmp_path / name
    assert command.site(site, output=place) == 3
    told = capsys.readouterr().out
    page = tmp_path / "v.html"
    if name == "v.toml":
        assert asked == [("output", place, "values of a site", report.written_by_site, (".toml",), [site]), site]
        assert place.read_text() == "values of study values" and page.read_text() == "page of study values text"
        assert told == f"written: {place}, {page}\n"
    else:
        assert asked == [("result", place, "site", [site]), site, ("write", place)]
        assert told == f"written: {place}\n" and not page.exists()


@pytest.mark.parametrize(("names", "share", "cells"), [
    ((), 0.5, ["place", "–", "–", "–", "–", "–"]), (("a",), 0.5, ["place", "3000", "a", "50 %", "2000", "0"]),
    (("a",), float("nan"), ["place", "3000", "a", "not given", "2000", "0"]), (None, 0.5, []),
])  # fmt: skip
def test_a_load_case_has_its_largest_tension_and_pulls_in_kilonewtons(monkeypatch, names, share, cells):
    row = {
        "largest_tension_N": 3e6,
        "line": "a",
        "of_breaking_load": share,
        "horizontal_at_anchor_N": 2e6,
        "uplift_at_anchor_N": -1e5,
    }
    monkeypatch.setattr(report_words, "CASE_HEAD", tuple(row))
    monkeypatch.setattr(report_words, "case_row", lambda one: tuple(row.values()))
    monkeypatch.setattr(report_words, "_place_words", lambda row, place: [place])
    monkeypatch.setattr(report_words, "farthest", lambda numbers: ("place", 0.0))
    monkeypatch.setattr(report_words, "percent", lambda share: f"{100 * share:g} %")
    one = SimpleNamespace(
        numbers=None if names is None else SimpleNamespace(names=names), case=SimpleNamespace(name="storm"), fault="f"
    )
    made = report_words.case(one, {"storm": "link"})
    assert made == {"name": "storm", "link": "link", "fault": "f", "cells": cells}


@pytest.mark.parametrize(
    ("kind", "words"), [("mean_period", "2.5 m, 8 s (mean period)"), ("peak_period", "2.5 m, 8 s (peak period)")]
)
def test_a_system_of_waves_is_told_with_its_height_and_the_kind_of_its_period(monkeypatch, kind, words):
    monkeypatch.setattr(report_words, "period_of", lambda where, waves: {kind: 8.0})
    assert report_words._system(SimpleNamespace(file=None, height=2.5)) == words
    assert report_words._system(SimpleNamespace(file="folder/sea.spc", height=None)) == "sea.spc"
