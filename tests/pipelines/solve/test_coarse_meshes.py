"""Honest coarse meshes keep the laws better than a run has to, so that a run that fails is not just coarse."""

import numpy as np

from hakobune.bem.database import open_database
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.report import BROKEN, failed_laws
from hakobune.pipelines.solve.run import solve

LAWS = ("reciprocity", "Haskind", "energy")


def coarse_scene(rng):
    """A box or buoy on 24 to 80 panels, half a draft and more under its keel, in waves of any length"""
    length = 10 ** rng.uniform(1.0, 2.3)
    if rng.random() < 0.5:
        beam = length * rng.uniform(0.2, 1.0)
        draft = beam * 10 ** rng.uniform(-1.0, 0.0)
        body = {"shape": "box", "length": length, "beam": beam, "draft": draft}
    else:
        draft = length * 10 ** rng.uniform(-1.0, 0.3)
        body = {"shape": "buoy", "radius": length / 2, "draft": draft}
    depth = draft * float(rng.choice([1.5, 3.0, 10.0]))
    k = 10 ** rng.uniform(-1.0, 0.6, 2) / length
    omegas = np.sqrt(9.81 * k * np.tanh(k * depth)).tolist()
    return make_scene(
        {"water": {"depth": depth}, "bodies": [body], "waves": {"omegas": omegas, "headings_deg": [0, 40, 90]},
         "panels": int(rng.choice([24, 40, 80])), "want": ["radiation", "diffraction", "kochin"], "method": "panel"}
    )  # fmt: skip


def test_twenty_random_coarse_meshes_keep_the_laws_that_a_run_is_held_to(tmp_path):
    rng, worst = np.random.default_rng(4), 0.0
    for i in range(20):
        solve(coarse_scene(rng), tmp_path / f"{i}.h5")
        db = open_database(tmp_path / f"{i}.h5")
        assert db.mesh.sizes.max() < np.pi / db["wavenumber"].max()
        assert failed_laws(db, own_panels=True) == ""
        worst = max(worst, *(np.nanmax(db.checks()[law]) for law in LAWS))
    assert 0.01 < worst < 0.8 * BROKEN
