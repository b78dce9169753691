"""`hakobune export` and `hakobune import`: what comes back is a database that its checks pass."""

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.bem.second_order.quadratic_forces import QuadraticForces
from hakobune.bem.second_order.stored import Held, StoredForces, read_forces, write_forces
from hakobune.meshing.files import write_mesh
from hakobune.mooring.motion.wave_loads import forces_towards
from hakobune.pipelines import cli
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.simulate.work import Task, prepared

BOX = "--length 40 --beam 20 --draft 5 --depth 20 --omega 0.3:0.9:3 --heading 0,45 --gyration 6,12,13"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("exchange")
    assert cli.main(["box", *BOX.split(), "--output", str(place / "box.h5")]) == 0
    T = np.random.default_rng(1).normal(size=(2, 3, 1, 1, 6)) + 0j
    T[1, 2] = np.nan
    omega = np.linspace(0.3, 0.9, 3)
    forces = QuadraticForces(omega, np.array([0.0, 0.3]), np.zeros(1), T, T, T)
    write_forces(place / "box.h5", StoredForces(forces, Held(True)))
    return place


@pytest.mark.parametrize("kind, place", [("wamit", "box.1"), ("hams", "box_hams"), ("nemoh", "box_nemoh")])
def test_a_database_goes_out_and_comes_back(kind, place, folder, capsys):
    assert cli.main(["export", str(folder / "box.h5"), "--to", kind]) == 0
    assert "cannot hold" in capsys.readouterr().err
    back = folder / f"{kind}.h5"
    depth = ["--depth", "20"] if kind == "wamit" else []
    assert cli.main(["import", str(folder / place), "--from", kind, "--output", str(back), *depth]) == 0
    assert cli.main(["check", str(back)]) == 0
    true, found = open_database(folder / "box.h5"), open_database(back)
    for name in ("added_mass", "excitation_force"):
        assert np.abs(found[name] - true[name]).max() <= 1e-6 * np.abs(true[name]).max()
    if kind == "wamit":
        shallow = ["--depth", "5", "--output", str(folder / "shallow.h5")]
        assert cli.main(["import", str(folder / place), "--from", kind, *shallow]) == 2
        assert "the water is 5 m deep, but" in capsys.readouterr().err and not (folder / "shallow.h5").exists()
        np.testing.assert_allclose(read_forces(found).forces.total, read_forces(true).forces.total, rtol=1e-5)


def test_an_import_that_breaks_off_leaves_the_old_file_as_it_was(folder, monkeypatch):
    from hakobune.pipelines.exchange import importing

    def full(*_):
        raise OSError(28, "No space left on device")

    assert cli.main(["export", str(folder / "box.h5"), "--to", "bemio", "--output", str(folder / "box_other.h5")]) == 0
    output = folder / "again.h5"
    words = ["import", str(folder / "box_other.h5"), "--from", "bemio", "--output", str(output)]
    words += ["--mesh", str(folder / "box.gdf"), "--fresh"]
    write_mesh(open_database(folder / "box.h5").mesh, folder / "box.gdf")
    assert cli.main(words) == 0
    before = output.read_bytes()
    with monkeypatch.context() as patch:
        patch.setattr(importing, "append_limit", full)
        assert cli.main(words) == 2
    assert output.read_bytes() == before and sorted(folder.glob("again*")) == [output]


def test_refusals_name_the_way_out(folder, capsys):
    box = str(folder / "box.h5")
    for arguments, said in (
        (["export", box, "--to", "aqwa"], "allowed: wamit, nemoh"),
        (["export", box, "--to", "bemio", "--output", box], "is the database itself"),
        (["import", box, "--from", "bemio"], "no file of BEMIO"),
        (["import", str(folder / "none.1"), "--from", "wamit"], "does not exist"),
    ):
        assert cli.main(arguments) == 2
        assert said in capsys.readouterr().err
    assert cli.main(["export", box, "--to", "capytaine"]) == 0
    assert cli.main(["export", box, "--to", "capytaine"]) == 2
    assert "--fresh" in capsys.readouterr().err
    assert cli.main(["import", str(folder / "box.nc"), "--from", "capytaine"]) == 2
    assert "give --mesh FILE" in capsys.readouterr().err
    assert cli.main(["import", str(folder / "box.nc"), "--from", "wamit"]) == 2
    assert "--depth is missing" in capsys.readouterr().err


def test_an_export_writes_over_no_hull_of_the_user(folder, tmp_path, capsys):
    (tmp_path / "own.h5").write_bytes((folder / "box.h5").read_bytes())
    (tmp_path / "own.gdf").write_text("a hull of the user")
    words = ["export", str(tmp_path / "own.h5"), "--to", "wamit"]
    assert cli.main(words) == 0
    assert (tmp_path / "own_wamit.gdf").exists() and (tmp_path / "own_wamit.1").exists()
    assert cli.main([*words, "--output", str(tmp_path / "own.1")]) == 2
    assert "own.gdf exists already; give --fresh" in capsys.readouterr().err
    assert (tmp_path / "own.gdf").read_text() == "a hull of the user" and not (tmp_path / "own.1").exists()


def test_frequencies_that_are_not_finite_are_left_out_and_named(folder, tmp_path, capsys):
    assert cli.main(["export", str(folder / "box.h5"), "--to", "wamit", "--output", str(tmp_path / "box.1")]) == 0
    path = tmp_path / "box.3"
    lines = path.read_text().splitlines()
    lines[0] = " ".join([*lines[0].split()[:3], "NaN", "0", "NaN", "NaN"])
    path.write_text("\n".join(lines))
    words = ["import", str(tmp_path / "box.1"), "--from", "wamit", "--depth", "20", "--output", str(tmp_path / "b.h5")]
    assert cli.main(words) == 1
    assert "excitation_force is not finite at" in capsys.readouterr().err
    assert len(open_database(tmp_path / "b.h5").omega) == 2


def test_files_with_one_heading_run_in_waves_to_it_or_its_image_and_are_refused_in_others(tmp_path):
    """The forces of a box in head seas, turned by 0.1 rad: the surge force has a sway part of sin 0.1 along its axes"""
    box = f"{BOX} --center-of-gravity 0,0,1".replace("0.3:0.9:3", "0.3:1.5:6").replace("0,45 ", "0 ").split()
    own, back = tmp_path / "box.h5", tmp_path / "back.h5"
    assert cli.main(["box", *box, "--only", "radiation,excitation_force,rao", "--output", str(own)]) == 0
    assert cli.main(["export", str(own), "--to", "wamit", "--output", str(tmp_path / "box.1")]) == 0
    words = ["--depth", "20", "--gyration", "6,12,13", "--center-of-gravity", "0,0,1", "--output", str(back)]
    assert cli.main(["import", str(tmp_path / "box.1"), "--from", "wamit", *words]) == 0
    springs = {"memory": "constant", "spring": {"surge": 100.0, "sway": 100.0, "yaw": 5000.0}, "duration": 60.0}

    def made(direction, **more):
        sea = {"height": 1.0, "period": 9.0, "direction_deg": direction} | more
        study = {"water": {"depth": 20.0}, "waves": sea, "simulation": springs}
        return prepared(Task(make_study(study), str(back), None, None))

    body, plan, _ = made(180.0)
    assert any("waves to 0°, 180° alone, and the forces keep their direction in space" in one for one in plan.told)
    surge, sway = forces_towards(body.waves, -0.1)[:, :2].T
    assert np.abs(sway + np.tan(0.1) * surge).max() < 1e-5 * np.abs(surge).max()
    with pytest.raises(
        ValueError, match=r"waves travel to 30°, but the imported files have forces of waves towards 0°, 180° only"
    ):
        made(30.0)
    with pytest.raises(ValueError, match="waves have a spreading, but the imported files"):
        made(0.0, spreading="cosine:4")


def test_a_simulation_of_files_without_drift_says_so_first(tmp_path):
    """Nemoh's files have no drift; nothing is said where it is not asked for, nor of a database of our own"""
    box = f"{BOX} --center-of-gravity 0,0,1".replace("0.3:0.9:3", "0.3:1.5:6").replace("0,45 ", "0:180:5 ").split()
    own, back = tmp_path / "box.h5", tmp_path / "back.h5"
    assert cli.main(["box", *box, "--only", "radiation,excitation_force,rao,drift_force", "--output", str(own)]) == 0
    assert cli.main(["export", str(own), "--to", "nemoh", "--output", str(tmp_path / "files")]) == 0
    words = ["--gyration", "6,12,13", "--center-of-gravity", "0,0,1"]
    assert cli.main(["import", str(tmp_path / "files"), "--from", "nemoh", "--output", str(back), *words]) == 0
    sea = {"height": 1.0, "period": 9.0, "direction_deg": 30.0}
    springs = {"memory": "constant", "spring": {"surge": 100.0, "sway": 100.0, "yaw": 5000.0}}

    def said(path, **more):
        study = {"water": {"depth": 20.0}, "waves": sea, "simulation": {**springs, "duration": 60.0, **more}}
        return [line for line in prepared(Task(make_study(study), str(path), None, None))[1].told if "drift of" in line]

    assert said(back)[0].startswith("left out: the drift of the waves, which the imported files do not contain")
    assert not said(back, slow_drift="none") and not said(own)
