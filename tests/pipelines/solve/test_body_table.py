"""The table of a body at rest that a run ends with."""

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.report import body_table
from hakobune.pipelines.solve.run import solve

RHO_G = 1025 * 9.80665


def test_the_summary_gives_the_periods_at_which_inertia_and_stiffness_balance(tmp_path):
    raw = {
        "water": {"depth": 20.0},
        "bodies": [{"shape": "box", "length": 40.0, "beam": 20.0, "draft": 5.0, "gyration": [6, 12, 13]}],
        "waves": {"omegas": [0.7, 0.8, 0.9, 1.0], "headings_deg": [0]},
        "want": ["added_mass"],
    }
    solve(make_scene(raw), tmp_path / "box.h5")
    db = open_database(tmp_path / "box.h5")
    rows = dict(zip(*(list(column.cells) for column in body_table(db).columns[:2]), strict=True))
    omega = 2 * np.pi / float(rows["natural period, heave"])
    A = np.interp(omega, db.omega, db["added_mass"][:, 2, 2])
    assert omega == pytest.approx(np.sqrt(RHO_G * 800 / (db.mass + A)), rel=5e-3)  # straight lines between 0.8 and 0.9
    assert rows["natural period, pitch"] and "natural period, surge" not in rows
