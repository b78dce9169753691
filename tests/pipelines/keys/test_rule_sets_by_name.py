"""Names of rule sets, subjects and quantities in `hakobune keys`, and the doubts that studies tell of a database."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.criteria.rule_lines import QUANTITIES, rule_lines
from hakobune.pipelines.cli import main
from hakobune.pipelines.design.kinds import needs
from hakobune.pipelines.simulate.over_runs import lifted
from hakobune.pipelines.solve import report


def test_every_quantity_that_parts_of_a_study_need_is_listed():
    own = (*needs.LOADS, *needs.OF_FENDERS, needs.DOLPHIN, needs.SCOPE, needs.EXCURSION, needs.ANCHOR, needs.GAP)
    assert set(own) <= set(QUANTITIES)
    told = " ".join(" ".join(rule_lines()).split())
    assert '"PIANC": "fishing vessel; elevator crane"' in told and all(f'"{one}"' in told for one in own)


@pytest.mark.parametrize("words, said", [
    (["JSCE"], "breaking load / tension at least 3; chain of a multi-point mooring, state abnormal, lines intact"),
    (["PIANC", "tanker"], "surge at most 3 m; oil tanker; loading arms, state normal, peak to peak"),
    (["excursion"], '[[limits]] of a design: quantity = "excursion"'), (["design", "rules"], "quantity of [[limits]]:"),
])  # fmt: skip
def test_a_name_of_a_rule_or_quantity_is_found_by_keys(words, said, capsys):
    assert main(["keys", *words]) == 0
    assert said in capsys.readouterr().out


def test_a_database_that_is_incomplete_or_breaks_a_law_is_told_of(monkeypatch):
    db = SimpleNamespace(complete=False, path="a.h5", omega=np.zeros(22), rows=np.ones(24), attributes={})
    monkeypatch.setattr(report, "stored_checks", lambda db: [])
    (text,) = report.doubts(db)
    assert text.startswith("a.h5 is incomplete: 22 of 24 frequencies are solved")
    broken = SimpleNamespace(name="reciprocity", largest=0.4, limit=0.01, omega=1.0)
    monkeypatch.setattr(report, "stored_checks", lambda db: [broken])
    db.complete = True
    (text,) = report.doubts(db)
    assert "reciprocity is broken by 0.4 at ω = 1 rad/s, limit 0.01" in text


def test_a_lifted_anchor_is_told_where_the_line_lies_at_rest_and_no_table_judges_it():
    along, up, lies = np.full(4, 1e5), np.array([5e3, 9e3, 2e4, 0.0]), np.array([20.0, 0.0, 30.0, 30.0])
    (text,) = lifted(["a", "taut", "judged", "low"], [None, None, "table", None], along, up, lies)
    assert text.startswith("1 of 4 lines leave the bed") and "most of all a with 5 kN" in text
