"""`hakobune qtf` of a barge beside a pontoon: stored by names, on the diagonal the drift of each, out and in again."""

import numpy as np
import pytest
import tomli_w
from scipy.spatial.transform import Rotation

import hakobune
from hakobune.bem.database import open_database
from hakobune.bem.modes import names_of
from hakobune.bem.second_order.stored import read_forces
from hakobune.pipelines.cli import main

SCENE = {
    "water": {"depth": 12.0},
    "panels": 60,
    "bodies": [
        {"name": "barge", "shape": "box", "length": 30.0, "beam": 12.0, "draft": 3.0, "place": [0.0, 12.0, 30.0],
         "gyration": [4.0, 8.0, 8.5]},
        {"name": "pontoon", "shape": "box", "length": 40.0, "beam": 8.0, "draft": 6.0, "place": [0.0, -8.0, 0.0],
         "gyration": [3.0, 10.0, 11.0], "center_of_gravity": [0.0, 0.0, -2.0]},
    ],
    "waves": {"omegas": {"from": 0.5, "to": 1.0, "count": 6}, "headings_deg": [90.0]},
}  # fmt: skip


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pairs")
    (folder / "pontoon.toml").write_text(tomli_w.dumps(SCENE))
    path = folder / "pontoon.h5"
    assert main(["solve", str(folder / "pontoon.toml"), "--output", str(path)]) in (0, 1)
    assert main(["qtf", str(path), "--omega", "0.5:1:6", "--difference", "0.2", "--plot", f"{path}.png"]) == 0
    return path


def test_pairs_of_one_frequency_have_the_stored_drift_of_each_body(path):
    db, stored = open_database(path), read_forces(open_database(path))
    assert stored.names == names_of(db.bodies) and stored.words[:1] + stored.words[6:7] == [
        "barge surge",
        "pontoon surge",
    ]
    mean = stored.forces.squares[0, :, 0, 0].reshape(6, 2, 6)[..., [0, 1, 5]]
    np.testing.assert_allclose(mean, db["body_drift_force"][:, 0], rtol=1e-9, atol=1e-6 * np.abs(mean).max())


def test_what_is_printed_names_each_body_and_what_is_left_out(path, capsys):
    made = hakobune.qtf(path)
    assert main(["qtf", str(path)]) == made.status == 0
    said = capsys.readouterr().out
    assert "90° barge sway, 0 rad/s" in said and "90° pontoon yaw, 0.2 rad/s" in said
    assert "floating bodies, 6 frequencies" in said and "forcing around the bodies" in said
    assert "barge sway" in said.partition("estimated error of the panels")[2]


@pytest.mark.parametrize("words, named", [("--level full", "--level full"), ("--moored s.toml", "--moored")])
def test_what_only_one_body_has_is_refused(path, words, named, capsys):
    assert main(["qtf", str(path), *words.split()]) == 2
    assert f"{named} is given for 2 bodies" in capsys.readouterr().err


def test_pairs_come_back_from_the_files_of_another_program(path, tmp_path, capsys):
    assert main(["export", str(path), "--to", "wamit", "--output", str(tmp_path / "w")]) in (0, 1)
    hulls = "w_barge.gdf\n0. 12. 0. 0.\n1 1 1 1 1 1\nw_pontoon.gdf\n0. -8. 0. 0.\n1 1 1 1 1 1\n"
    (tmp_path / "w.pot").write_text(f"two\n12.\n1 1\n0\n0\n2\n{hulls}")
    for words, chosen in (("--bodies barge,pontoon", slice(None)), (f"--body 1 --mesh {tmp_path}/w_barge.gdf", slice(6))):
        came = tmp_path / f"{len(words)}.h5"
        place = [str(tmp_path / "w.1"), "--from", "wamit", "--depth", "12", "--output", str(came)]
        assert main(["import", *place, *words.split()]) in (0, 1), capsys.readouterr().err
        found, wanted = read_forces(open_database(came)), read_forces(open_database(path)).forces.total
        turn = np.kron(np.eye(2), Rotation.from_euler("z", 30, degrees=True).as_matrix())  # of the barge's axes
        along = np.concatenate([wanted[..., :6] @ turn.T, wanted[..., 6:]], axis=-1)[..., chosen]
        np.testing.assert_allclose(found.forces.total, along, rtol=1e-5, atol=1e-6 * np.nanmax(np.abs(along)))
