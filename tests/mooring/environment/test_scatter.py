"""Scatter diagrams: what a table says, and what is no table."""

import numpy as np
import pytest

from hakobune.mooring.environment.scatter import Scatter, read_scatter
from hakobune.mooring.environment.spectra import mitsuyasu_bretschneider
from hakobune.mooring.environment.tables import TableError

TABLE = "# a harbour\nsignificant_period,4.5,5.5,6.5\n0.25,12,30,\n0.75,0,18,20\n"


def written(tmp_path, text):
    path = tmp_path / "scatter.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_counts_become_probabilities_of_their_classes(tmp_path):
    scatter = read_scatter(written(tmp_path, TABLE))
    assert scatter.period_kind == "significant_period"
    assert scatter.heights.tolist() == [0.25, 0.75] and scatter.periods.tolist() == [4.5, 5.5, 6.5]
    np.testing.assert_allclose(scatter.probability, np.array([[12, 30, 0], [0, 18, 20]]) / 80)
    assert [state[:2] for state in scatter.states()] == [(0.25, 4.5), (0.25, 5.5), (0.75, 5.5), (0.75, 6.5)]


def test_spectra_of_the_classes_have_their_periods_and_all_of_the_probability(tmp_path):
    scatter = read_scatter(written(tmp_path, TABLE))
    spectra = [(mitsuyasu_bretschneider(h, **{scatter.period_kind: t}), p) for h, t, p in scatter.states()]
    np.testing.assert_allclose([s.T_significant for s, _ in spectra], [4.5, 5.5, 5.5, 6.5])
    assert abs(sum(p for _, p in spectra) - 1) < 1e-14
    mean_square = sum(p * s.moment(0) for s, p in spectra)
    assert abs(mean_square / 0.06238 - (42 * 0.25**2 + 38 * 0.75**2) / 80) < 1e-4


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (TABLE.replace("significant_period", "period"), "period kind is 'period'; allowed: mean_period"),
        (TABLE.replace("0.75,0", "0.75,-1"), "smallest probability is -1"),
        (TABLE.replace("5.5", "4.5"), "period of a class goes from 4.5 to 4.5"),
        (TABLE.replace("0.25,12", "0.95,12"), "height of a class goes from 0.95 to 0.75"),
        (TABLE.replace("0.25,12", "0,12"), "the first classes of the scatter diagram are 0 m"),
        (TABLE.replace("18", "many"), "line 4 has 'many'"),
        ("1,2\n3,4\n", "begins with a number; allowed: mean_period"),
        ("mean_period,4,5\n1,0,0\n", "allowed: at least 0, and above 0 somewhere"),
    ],
)
def test_what_is_no_scatter_diagram_is_refused_with_its_file(tmp_path, text, words):
    with pytest.raises(TableError, match=words) as error:
        read_scatter(written(tmp_path, text))
    assert "scatter.csv" in str(error.value)


def test_shape_of_the_probability_is_that_of_the_classes():
    with pytest.raises(ValueError, match="2 heights and 1 periods"):
        Scatter([1.0, 2.0], [8.0], [[1.0, 1.0]], "mean_period")
