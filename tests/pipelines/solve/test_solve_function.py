"""`hakobune.solve`: a scene as path, tables or Scene gives one database."""

import numpy as np
import pytest
import tomli_w

import hakobune
from hakobune.bem.database import DatabaseError
from hakobune.pipelines.scene.scene import make_scene

SCENE = {
    "water": {"depth": 20.0},
    "bodies": [{"shape": "buoy", "radius": 5.0, "draft": 4.0, "gyration": [3.0, 3.0, 3.0]}],
    "waves": {"omegas": [0.6, 1.0], "headings_deg": [0.0]},
    "panels": 60,
    "want": ["added_mass", "radiation_damping", "excitation_force"],
}


@pytest.mark.filterwarnings("ignore::UserWarning")  # of panels that are coarse
def test_path_tables_and_scene_give_the_same_database(tmp_path):
    (tmp_path / "scene.toml").write_text(tomli_w.dumps(SCENE))
    given = (tmp_path / "scene.toml", str(tmp_path / "scene.toml"), SCENE, make_scene(SCENE))
    made = [hakobune.solve(one, tmp_path / f"{k}.h5") for k, one in enumerate(given)]
    for db in made:
        assert isinstance(db, hakobune.Database) and db.complete
        assert np.array_equal(db["added_mass"], made[0]["added_mass"])


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_what_the_command_remarks_is_a_warning_and_a_frequency_without_a_result_an_error(tmp_path, monkeypatch):
    from hakobune.pipelines.solve import run

    coarse = {**SCENE, "waves": {"omegas": [2.5], "headings_deg": [0.0]}}
    with pytest.warns(UserWarning, match="coarse"):
        hakobune.solve(coarse, tmp_path / "coarse.h5")
    solve_one = run.solve_one

    def refused(problem, omega, *rest):
        if omega > 0.8:
            raise ValueError("no convergence")
        return solve_one(problem, omega, *rest)

    monkeypatch.setattr(run, "solve_one", refused)
    with pytest.raises(ValueError, match=r"ω = 1 rad/s is not solved: ValueError: no convergence"):
        hakobune.solve(SCENE, tmp_path / "buoy.h5")
    assert np.allclose(hakobune.open_database(tmp_path / "buoy.h5").omega, [0.6])
    monkeypatch.undo()
    assert hakobune.solve(SCENE, tmp_path / "buoy.h5").complete


def test_a_scene_that_cannot_be_is_refused_and_leaves_no_file(tmp_path):
    with pytest.raises(ValueError, match=r"bodies\[0\].draft"):
        hakobune.solve({**SCENE, "water": {"depth": 3.0}}, tmp_path / "none.h5")
    assert not list(tmp_path.iterdir())
    with pytest.raises(DatabaseError, match="does not exist"):
        hakobune.open_database(tmp_path / "none.h5")
