"""Natural periods of the tank models of the SR179 report (1982), Table 2.4.4.1, by way of scene and database."""

import csv
from pathlib import Path

import numpy as np
import pytest

from hakobune import pipelines
from hakobune.bem.database import open_database
from hakobune.bem.database.natural_periods import natural_periods
from hakobune.pipelines.cli import main

SCENES = Path(pipelines.__file__).parent / "scenes"
TABLE = Path(__file__).parents[1] / "published" / "model_particulars.csv"


def published():
    """{model: {column: number}}, NaN where nothing was measured"""
    with TABLE.open() as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {row.pop("model"): {key: float(value or "nan") for key, value in row.items()} for row in rows}


@pytest.mark.parametrize(
    ("scene", "model"),
    [("model_M3A_d250", "M3A_Bd10"), ("model_M3A_d125", "M3A_Bd20"), ("model_M3B_d194", "M3B_Bd10")],
)
def test_roll_period_of_a_model_is_the_measured_one_within_five_per_cent(scene, model, tmp_path):
    """−3.2, −0.1 and −2.6 % of 2.07, 1.50 and 1.78 s, without the lengthening by damping.

    Five per cent: the report prints three digits, and the radiation damping of up to 0.12 of the critical shifts a
    measured decay by some per cent.  Pitch comes out 2.8, 9.4 and 12.2 % below 1.87, 1.68 and 1.87 s; its damping,
    up to 0.14 of the critical, explains two of these per cent, and the rest is open.
    """
    row, path = published()[model], tmp_path / "model.h5"
    assert main(["solve", str(SCENES / f"{scene}.toml"), "--only", "added_mass", "--output", str(path)]) == 0
    db = open_database(path)
    found = natural_periods(db.reader)
    assert found.inside[3]
    assert np.isclose(found.period[3], row["T_roll_s"], rtol=0.05), found

    # the scene is the model of the table
    sizes = [row[key] for key in ("L_m", "B_m", "d_m")]
    assert np.allclose(list(db.dimensions.values()), sizes, rtol=0.01)
    assert np.isclose(db.mass, row["mass_kg"], rtol=0.005)
    assert np.isclose(db.center_of_mass[2], row["KG_m"] - row["d_m"], atol=5e-4)
    height = row["B_m"] ** 2 / (12 * row["d_m"]) + 0.5 * row["d_m"] - row["KG_m"]
    assert np.isclose(db.transverse_metacentric_height, height, rtol=1e-3)
    radii = np.sqrt(np.diag(db.inertia_matrix)[3:] / db.mass - np.array([1, 1, 0]) * db.center_of_mass[2] ** 2)
    assert np.allclose(radii, [row[key] for key in ("k_xx_m", "k_yy_m", "k_zz_m")], rtol=1e-6)
