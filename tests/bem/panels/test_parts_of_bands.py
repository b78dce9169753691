"""Frequencies that a band does not suit, sketches that grow, and which pressures panels may have."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.panels.band import low_rank_waves
from hakobune.bem.panels.band import one_frequency as band
from hakobune.bem.panels.pressure_drift import mean_drift


def run(hull, solution=None, nodes=4, error=0.01):
    made = object.__new__(band.BandRun)
    made.omega, made.problem = 0.7, SimpleNamespace(nodes_per_panel=nodes)
    vars(made)["geometry"], vars(made)["solution"] = SimpleNamespace(hull=hull), solution
    made.equations_of_band = SimpleNamespace(accuracy=1e-3)
    return made


def test_a_rejected_frequency_is_solved_whole_or_compressed_or_refused():
    """Compressed where the full equations are too large, on panels of four nodes"""
    most = band.LARGEST_FULL_SYSTEM
    assert run(most).rejected(0.01) is None and run(most, nodes=1).rejected(0.01) is None
    assert run(most + 1).rejected(0.01) is None
    with pytest.raises(FloatingPointError) as refused:
        run(most + 1, nodes=1).rejected(0.0123)
    assert "the low-rank approximation of the band's waves has an error of 1.2e-02; allowed: " in str(refused.value)
    assert f"{band.ALLOWED * 1e-3:.1e}; give a narrower band" in str(refused.value)
    assert run(most + 1).compressed and not run(most).compressed and not run(most + 1, solution="there").compressed
    assert run(most).enlarged(1.0, 2.0) == (1.0, 2.0)


def test_a_solution_is_finite_or_the_frequency_is_named():
    one = run(9)
    assert one.checked(lambda: (np.ones(2), np.zeros(1)))[1].tolist() == [0.0]
    with pytest.raises(FloatingPointError, match=r"ω = 0\.7 rad/s: the solution is not finite"):
        one.checked(lambda: (np.ones(2), np.array([np.nan])))

    def singular():
        raise np.linalg.LinAlgError("Singular matrix")

    with pytest.raises(FloatingPointError, match=r"ω = 0\.7 rad/s: Singular matrix"):
        one.checked(singular)


@pytest.mark.parametrize("rank, widths", [(5, [16]), (6, [16, 36]), (12, [16, 72]), (39, [16, 96, 120])])
def test_a_sketch_is_three_times_as_wide_as_its_rank(rank, widths, monkeypatch):
    """16 columns; while three times the rank found is more, twice as many, or six times that rank, up to 3 × 40"""
    seen = []

    class Counted:
        def __init__(self, scale, width):
            seen.append(width)
            self.matrix = np.zeros((len(scale), width))

    def found(matrix, tolerance):
        count = min(rank, matrix.shape[1])
        return np.arange(count), f"X of {count}"

    monkeypatch.setattr(low_rank_waves, "FIRST_COLUMNS", 16)
    monkeypatch.setattr(low_rank_waves, "Sketch", Counted)
    monkeypatch.setattr(low_rank_waves, "interpolative_decomposition", found)
    filled = []
    selected, X = low_rank_waves._decomposed(filled.append, np.ones(40), 1e-9)
    assert len(selected) == rank and f"X of {rank}" == X and seen == widths and len(filled) == len(widths)


def test_pressures_are_of_four_nodes_a_panel_and_of_a_hull_with_sides(monkeypatch):
    problem = SimpleNamespace(nodes_per_panel=4, zero_draft=False, depth=9.0)
    most = mean_drift.LONGEST_PER_GAP
    for share, told in ((0.99, False), (1.01, True)):
        monkeypatch.setattr(mean_drift, "coarsest_at_gap", lambda mesh, depth, share=share: (share * most * 2.0, 2.0))
        if told:
            with pytest.warns(UserWarning, match=rf"long over a gap of 2 m; reliable: up to {2 * most:.3g} m"):
                mean_drift.check_panels(problem, None)
        else:
            mean_drift.check_panels(problem, None)
    problem.zero_draft = True
    with pytest.raises(ValueError, match="near-field drift needs a hull with sides"):
        mean_drift.check_panels(problem, None)
    problem.nodes_per_panel = 1
    with pytest.raises(ValueError, match="nodes_per_panel is 1; near-field drift needs 4"):
        mean_drift.check_panels(problem, None)
