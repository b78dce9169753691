"""Two bodies in a file of BEMIO: rows of each, columns of all, about their centres of gravity, and back again."""

import h5py
import numpy as np
import pytest
import tomli_w

from hakobune.bem.database import open_database
from hakobune.meshing.files import write_mesh
from hakobune.pipelines.cli import main

SCENE = {
    "water": {"depth": 12.0},
    "panels": 60,
    "bodies": [
        {"name": "float", "shape": "box", "length": 12.0, "beam": 8.0, "draft": 2.0, "place": [0.0, 8.0, 30.0],
         "gyration": [2.0, 3.0, 3.5], "center_of_gravity": [0.1, 0.0, 0.3]},
        {"name": "spar", "shape": "box", "length": 10.0, "beam": 6.0, "draft": 3.0, "place": [1.0, -7.0, 0.0],
         "gyration": [2.0, 3.0, 3.0], "center_of_gravity": [0.0, 0.01, -1.0]},
    ],
    "waves": {"omegas": {"from": 0.6, "to": 1.4, "count": 3}, "headings_deg": [0.0, 60.0]},
}  # fmt: skip


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bemio")
    (folder / "two.toml").write_text(tomli_w.dumps(SCENE))
    assert main(["solve", str(folder / "two.toml"), "--output", str(folder / "two.h5")]) in (0, 1)
    assert main(["export", str(folder / "two.h5"), "--to", "bemio", "--output", str(folder / "two_bemio.h5")]) in (0, 1)
    return folder


def arms(db):
    """(2, 3) m from the rotation centre of each to its centre of gravity, along the axes of the scene, by hand"""
    return np.array([np.append(0.1 * np.cos([np.pi / 6, np.pi / 3]), 0.3), [0.0, 0.01, -1.0]])


def test_each_body_has_rows_of_its_own_and_columns_of_all_about_its_centre_of_gravity(place):
    """Heave is that about any point; the spar's axes are those of the scene"""
    db = open_database(place / "two.h5")
    A, B, X = (db[name] for name in ("added_mass", "radiation_damping", "excitation_force"))
    x, y, _ = arms(db)[0]
    with h5py.File(place / "two_bemio.h5") as file:
        one, two = file["body1"], file["body2"]
        assert two["properties/dof_start"][0, 0] == 7 and two["properties/name"][()] == b"spar"
        np.testing.assert_allclose(one["properties/cg"][:, 0], [x, 8 + y, 0.3], atol=1e-9)
        own, other = (one[f"hydro_coeffs/{name}/all"][()] for name in ("added_mass", "radiation_damping"))
        assert own.shape == (6, 12, 3) and one["hydro_coeffs/radiation_damping/impulse_response_fun/K"].shape[:2] == (
            6,
            12,
        )
        np.testing.assert_allclose(own[2, [2, 8]], A[:, 2, [2, 8]].T / 1025, rtol=1e-9)
        np.testing.assert_allclose(other[2, 8], B[:, 2, 8] / 1025 / db.omega, rtol=1e-9)
        pitch = A[:, 10] + 1.0 * A[:, 6]  # M_y + x F_z − z F_x, G of the spar 1 m below its point
        np.testing.assert_allclose(two["hydro_coeffs/added_mass/all"][4, 2], pitch[:, 2] / 1025, rtol=1e-9)
        heave = two["hydro_coeffs/excitation/re"][2, 1] - 1j * two["hydro_coeffs/excitation/im"][2, 1]
        np.testing.assert_allclose(heave, X[:, 1, 8] / (1025 * 9.80665), rtol=1e-9)


def test_what_is_written_comes_back_with_its_couplings(place):
    db = open_database(place / "two.h5")
    for i, name in enumerate(("float", "spar")):
        write_mesh(db.mesh.of_body(i).whole(), place / f"{name}.gdf")
    out, hulls = place / "back.h5", ",".join(str(place / f"{name}.gdf") for name in ("float", "spar"))
    words = ["--from", "bemio", "--bodies", "float,spar", "--mesh", hulls, "--output", str(out)]
    assert main(["import", str(place / "two_bemio.h5"), *words]) in (0, 1)
    back = open_database(out)
    assert [body.name for body in back.bodies] == ["float", "spar"] and back["added_mass"].shape == (3, 12, 12)
    T = np.eye(12)
    for i, (x, y, z) in enumerate(arms(db)):  # motion of the rotation centre of unit rotations about the new point
        T[6 * i : 6 * i + 3, 6 * i + 3 : 6 * i + 6] = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = np.eye(12)
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    turn[:6, :6] = np.kron(np.eye(2), [[c, s, 0], [-s, c, 0], [0, 0, 1]])  # own by scene
    for name in ("added_mass", "radiation_damping"):
        wanted = T.T @ turn.T @ db[name] @ turn @ T
        np.testing.assert_allclose(back[name], wanted, atol=1e-9 * np.abs(wanted).max())
    wanted = db["excitation_force"] @ turn @ T
    np.testing.assert_allclose(back["excitation_force"], wanted, atol=1e-9 * np.abs(wanted).max())


def test_a_fixed_body_is_refused_and_a_mesh_is_wanted_for_each(place, capsys):
    scene = SCENE | {"bodies": [SCENE["bodies"][0], SCENE["bodies"][1] | {"fixed": True}]}
    (place / "pier.toml").write_text(tomli_w.dumps(scene))
    assert main(["solve", str(place / "pier.toml"), "--output", str(place / "pier.h5")]) in (0, 1)
    assert main(["export", str(place / "pier.h5"), "--to", "bemio"]) == 2
    assert "spar is fixed, but this format is for bodies that all move" in capsys.readouterr().err
    words = ["--from", "bemio", "--bodies", "float,spar", "--mesh", str(place / "float.gdf")]
    assert main(["import", str(place / "two_bemio.h5"), *words]) == 2
    assert "a file for each of float, spar" in capsys.readouterr().err
