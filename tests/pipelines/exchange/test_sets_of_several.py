"""Two floating bodies and a fixed one in the files of WAMIT, Nemoh and HAMS-MREL, and two of them back again."""

import numpy as np
import pytest
from scipy.optimize import brentq

from hakobune.bem.database import open_database
from hakobune.bem.formats import hams, nemoh, wamit
from hakobune.bem.formats.values import about, values_of
from hakobune.meshing.files import write_mesh
from hakobune.meshing.shapes import box, buoy
from hakobune.pipelines.cli import main
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.run import solve

SCENE = {
    "water": {"depth": 12.0},
    "panels": 240,
    "want": ["radiation", "limits", "diffraction", "motions"],
    "bodies": [
        {"name": "barge", "length": 10.0, "beam": 6.0, "draft": 3.0, "place": [0.0, 5.0, 30.0],
         "gyration": [2.0, 3.0, 3.0], "rotation_center": [1.0, 0.0, -1.0]},
        {"name": "spar", "shape": "buoy", "radius": 2.5, "draft": 6.0, "place": [4.0, -6.0, 0.0],
         "gyration": [2.0, 2.0, 1.5], "center_of_gravity": [0.0, 0.0, -4.0]},
    ],
    "waves": {"omegas": {"from": 0.8, "to": 1.2, "count": 3}, "headings_deg": [0.0, 45.0, 90.0]},
}  # fmt: skip
PIER = {"name": "pier", "length": 4.0, "beam": 4.0, "draft": 12.0, "place": [-12.0, 0.0, 0.0], "fixed": True}
PLACES = {"wamit": "set.1", "nemoh": "set", "hams": "set"}
WATER = ["--density", "1025", "--gravity", "9.80665"]


@pytest.fixture(scope="module")
def two(tmp_path_factory):
    path = tmp_path_factory.mktemp("two") / "two.h5"
    assert solve(make_scene(SCENE), path).exit_status == 0
    return path


@pytest.mark.parametrize("kind", PLACES)
def test_a_set_of_two_bodies_comes_back_by_the_names_of_the_bodies_alone(kind, two, tmp_path, capsys):
    """Hulls, points, depth and all couplings are in the files: written along the axes of the scene"""
    place, out = tmp_path / PLACES[kind], tmp_path / "back.h5"
    assert main(["export", str(two), "--to", kind, "--output", str(place)]) == 0
    assert "all bodies are in the axes of the scene" in capsys.readouterr().err
    water = WATER if kind != "nemoh" else []
    words = ["import", str(place), "--from", kind, "--bodies", "barge,spar", "--output", str(out), *water]
    assert main([*words, "--gyration", "2,3,3;2,2,1.5", "--center-of-gravity", "0,5,0;4,-6,-4"]) == 0
    back, there = open_database(out), values_of(open_database(two), several=True)
    assert [body.name for body in back.bodies] == ["barge", "spar"]
    for body, known in zip(back.bodies, there.bodies, strict=True):
        assert body.rotation_center == pytest.approx(known.rotation_center, abs=1e-5)
    for name in ("added_mass", "radiation_damping", "excitation_force"):
        assert np.abs(back[name] - there.get(name)).max() < 2e-5 * np.abs(there.get(name)).max(), name
    assert back["displaced_volume"] == pytest.approx([180.0, np.pi * 2.5**2 * 6], rel=1e-5)


def hulls_of(folder):
    """`--mesh` of both hulls, where they lie in the scene"""
    barge = box(10, 6, 3, panels=120, symmetry="").rotated(np.radians(30.0)).moved(0, 5, 0)
    write_mesh(barge, folder / "barge.gdf")
    write_mesh(buoy(2.5, 6.0, panels=120).whole().moved(4, -6, 0), folder / "spar.gdf")
    return f"{folder / 'barge.gdf'},{folder / 'spar.gdf'}"


def test_two_bodies_in_a_file_of_capytaine_come_back_with_their_hulls(two, tmp_path):
    """The file has no hulls: they are given, where they lie in the scene"""
    place, out = tmp_path / "set.nc", tmp_path / "back.h5"
    assert main(["export", str(two), "--to", "capytaine", "--output", str(place)]) == 0
    hulls = hulls_of(tmp_path)
    words = ["import", str(place), "--from", "capytaine", "--bodies", "barge,spar", "--mesh", hulls]
    words += ["--output", str(out)]
    assert main([*words, "--gyration", "2,3,3;2,2,1.5", "--center-of-gravity", "0,5,0;4,-6,-4"]) == 0
    back, there = open_database(out), values_of(open_database(two), several=True)
    for body, known in zip(back.bodies, there.bodies, strict=True):
        assert body.rotation_center == pytest.approx(known.rotation_center, abs=1e-9)
    for name in ("added_mass", "radiation_damping", "excitation_force"):
        np.testing.assert_allclose(back[name], there.get(name), rtol=1e-12, atol=1e-12 * np.abs(there.get(name)).max())


def test_beside_a_fixed_body_columns_are_of_the_bodies_that_move(tmp_path):
    """The barge is second here: its columns are the first, its rows the last"""
    scene, path = SCENE | {"bodies": [PIER, *SCENE["bodies"][:1]]}, tmp_path / "pier.h5"
    assert solve(make_scene(scene), path).exit_status == 0
    values = values_of(open_database(path), several=True)
    for kind, module in (("nemoh", nemoh), ("hams", hams), ("wamit", wamit)):
        place = tmp_path / kind / PLACES[kind]
        place.parent.mkdir()
        assert main(["export", str(path), "--to", kind, "--output", str(place)]) == 0
        known = {"density": 1025.0, "gravity": 9.80665, "body": 2}
        found = module.read(place, known)
        assert about(found, values.bodies[1].rotation_center).get("added_mass") == pytest.approx(
            values.get("added_mass")[:, 6:], rel=1e-5, abs=1.0
        )
    pressed = nemoh.read(tmp_path / "nemoh" / "set", {"body": 1}).get("excitation_force")
    assert pressed == pytest.approx(values.get("excitation_force")[..., :6], rel=1e-5, abs=1.0)


def test_two_structures_of_a_file_of_aqwa_come_back_with_their_hulls(two, tmp_path):
    """Written here after the manual: about the centres of gravity, with phases of a crest there"""
    centers = np.array([[0.0, 5.0, 0.0], [4.0, -6.0, -4.0]])
    there = about(values_of(open_database(two), several=True), centers)
    omega, beta, depth = there.omega, there.wave_direction, there.water_depth
    k = [brentq(lambda k, w=w: 9.80665 * k * np.tanh(k * depth) - w**2, 1e-3, 10.0) for w in omega]

    def line(*numbers):
        return " ".join(f"{x:.9E}" if isinstance(x, float) else str(x) for x in numbers)

    rows = [line(1, len(beta), len(omega), *map(float, np.degrees(beta))), line(*map(float, omega)), "GENERAL"]
    rows += [line(1, depth, 1025.0, 9.80665), "COG", *(line(i + 1, *map(float, c)) for i, c in enumerate(centers))]
    for title, name in (("ADDEDMASS", "added_mass"), ("DAMPING", "radiation_damping")):
        rows.append(title)
        for on, by, n in np.ndindex(2, 2, len(omega)):
            block = there.get(name)[n, 6 * on : 6 * on + 6, 6 * by : 6 * by + 6]
            rows.append(line(on + 1, by + 1, n + 1, *map(float, block.ravel())))
    rows.append("FORCERAO")
    for on, m, n in np.ndindex(2, len(beta), len(omega)):
        ahead = centers[on, 0] * np.cos(beta[m]) + centers[on, 1] * np.sin(beta[m])
        force = there.get("excitation_force")[n, m, 6 * on : 6 * on + 6] * np.exp(-1j * k[n] * ahead)
        rows.append(line(on + 1, m + 1, n + 1, *map(float, [*np.abs(force), *np.degrees(np.angle(force))])))
    place, out = tmp_path / "set.AH1", tmp_path / "back.h5"
    place.write_text("\n".join(rows) + "\n")
    hulls = hulls_of(tmp_path)
    words = ["import", str(place), "--from", "aqwa", "--bodies", "barge,spar", "--mesh", hulls, "--output", str(out)]
    assert main([*words, "--gyration", "2,3,3;2,2,1.5"]) == 0
    back = open_database(out)
    assert [body.rotation_center for body in back.bodies] == [tuple(c) for c in centers]
    for name in ("added_mass", "radiation_damping", "excitation_force"):
        assert np.abs(back[name] - there.get(name)).max() < 1e-8 * np.abs(there.get(name)).max(), name
