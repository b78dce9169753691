"""The scripts that fit the constants of the code run, on few bodies, and say what they found."""

from importlib import import_module

import pytest

# of each fitted constant the script that prints it again, and a line of what it prints
SCRIPTS = {
    "fit_interpolation": "tolerance kept by 2 of 2, largest error",
    "fit_contour_accuracy": "boxes in short waves, held out: 1 bodies",
    "fit_panel_counts": "| cylinders, held out | 1 |",
    "fit_lid_share": "SHARE in the code",
    "extrapolated": "LEFT, OF_WAVES in the code",
    "contour": "| box 100 × 50 × 10 × 20 | 1e-03 |",
    "sum_errors": "OF_SUMS in the code",
    "damping_floor": "| 1000 | ",
}


@pytest.mark.parametrize("name", SCRIPTS)
def test_a_script_that_fits_constants_runs_and_has_numbers_for_all(name, capsys):
    import_module(f"bench.{name}").main(["--quick"])
    printed = capsys.readouterr().out
    assert SCRIPTS[name] in printed, printed
    assert "nan" not in printed and "inf " not in printed
