"""`hakobune qtf` of a barge beside a pontoon: stored by names, on the diagonal the drift of each, out and in again."""

from types import SimpleNamespace

import numpy as np
import pytest
import tomli_w
from scipy.spatial.transform import Rotation

import hakobune
from hakobune.bem.database import open_database
from hakobune.bem.modes import names_of
from hakobune.bem.second_order.stored import read_forces
from hakobune.mooring.environment.sea import Components, Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.motion.simulation.loads import pairs
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.response.pair_levels import beside_newman_of_bodies
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
    "waves": {"omegas": {"from": 0.4, "to": 1.6, "count": 7}, "headings_deg": [90.0]},
}  # fmt: skip


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pairs")
    (folder / "pontoon.toml").write_text(tomli_w.dumps(SCENE))
    path = folder / "pontoon.h5"
    assert main(["solve", str(folder / "pontoon.toml"), "--output", str(path)]) in (0, 1)
    assert main(["qtf", str(path), "--omega", "0.4:1.6:7", "--difference", "0.4", "--plot", f"{path}.png"]) == 0
    return path


def test_pairs_of_one_frequency_have_the_stored_drift_of_each_body(path):
    db, stored = open_database(path), read_forces(open_database(path))
    assert stored.names == names_of(db.bodies) and stored.words[:1] + stored.words[6:7] == [
        "barge surge",
        "pontoon surge",
    ]
    mean = stored.forces.squares[0, :, 0, 0].reshape(7, 2, 6)[..., [0, 1, 5]]
    np.testing.assert_allclose(mean, db["body_drift_force"][:, 0], rtol=1e-9, atol=1e-6 * np.abs(mean).max())


def test_what_is_printed_names_each_body_and_what_is_left_out(path, capsys):
    made = hakobune.qtf(path)
    assert main(["qtf", str(path)]) == made.status == 0
    said = capsys.readouterr().out
    assert "90° barge sway, 0 rad/s" in said and "90° pontoon yaw, 0.4 rad/s" in said
    assert "floating bodies, 7 frequencies" in said and "forcing around the bodies" in said
    assert "barge sway" in said.partition("estimated error of the panels")[2]


@pytest.mark.parametrize("words, named", [("--level full", "--level full"), ("--moored s.toml", "--moored")])
def test_what_only_one_body_has_is_refused(path, words, named, capsys):
    assert main(["qtf", str(path), *words.split()]) == 2
    assert f"{named} is given for 2 bodies" in capsys.readouterr().err


def test_pairs_come_back_from_the_files_of_another_program(path, tmp_path, capsys):
    assert main(["export", str(path), "--to", "wamit", "--output", str(tmp_path / "w")]) in (0, 1)
    hulls = "w_barge.gdf\n0. 12. 0. 0.\n1 1 1 1 1 1\nw_pontoon.gdf\n0. -8. 0. 0.\n1 1 1 1 1 1\n"
    (tmp_path / "w.pot").write_text(f"two\n12.\n1 1\n0\n0\n2\n{hulls}")
    for words, chosen in (
        ("--bodies barge,pontoon", slice(None)),
        (f"--body 1 --mesh {tmp_path}/w_barge.gdf", slice(6)),
    ):
        came = tmp_path / f"{len(words)}.h5"
        place = [str(tmp_path / "w.1"), "--from", "wamit", "--depth", "12", "--output", str(came)]
        assert main(["import", *place, *words.split()]) in (0, 1), capsys.readouterr().err
        found, wanted = read_forces(open_database(came)), read_forces(open_database(path)).forces.total
        turn = np.kron(np.eye(2), Rotation.from_euler("z", 30, degrees=True).as_matrix())  # of the barge's axes
        along = np.concatenate([wanted[..., :6] @ turn.T, wanted[..., 6:]], axis=-1)[..., chosen]
        np.testing.assert_allclose(found.forces.total, along, rtol=1e-5, atol=1e-6 * np.nanmax(np.abs(along)))


def test_a_run_pushes_each_body_by_its_own_pairs_beside_newmans_rule(path):
    """Two waves at stored frequencies, 0.8 and 1 rad/s: 2 Re a b exp{i(ε − δ) − i 0.2 t} (T − √(DD'))"""
    db, sea = open_database(path), Sea(jonswap(0.5, peak_period=8.0), np.pi / 2)
    each, said = beside_newman_of_bodies(db, sea, "auto")
    assert len(each) == 2 and said[0].startswith("left out: the free-surface forcing")
    waves = Components(np.array([0.8, 1.0]), np.array([0.5, 0.3]), np.array([0.4, 1.1]), np.full(2, np.pi / 2))
    moored = SimpleNamespace(reader=db.bodies_reader, start=np.zeros(12), waves=SimpleNamespace(each=(Still, Still)))
    settings = Settings(duration=60.0, ramp=10.0, components=2)
    found = list(pairs(moored, Weather(seas=(sea,), beside_newman=(each,)), settings, waves))
    assert [one.body for one in found] == [0, 1]
    stored, grid = read_forces(db).forces, np.linspace(0.4, 1.6, 56)  # between which the drift is straight
    drift = db.bodies_reader.floating().drift_of_each(grid, [np.pi / 2])[:, 0]
    for body, force in enumerate(found):
        T = stored.total[1, 2, 0, 0, 6 * body : 6 * body + 6].copy()
        low, high = (np.array([np.interp(w, grid, d) for d in drift[:, body].T]) for w in (0.8, 1.0))
        T[[0, 1, 5]] -= np.where(low * high > 0, np.sign(low) * np.sqrt(np.abs(low * high)), 0.0)
        turn = np.exp(1j * (1.1 - 0.4) - 0.2j * (force.times + 10.0))
        wanted = 2 * 0.5 * 0.3 * np.real(turn[:, None] * T)
        np.testing.assert_allclose(force.force, wanted, atol=1e-8 * np.abs(wanted).max())


class Still:
    drift = None


def test_pairs_that_are_not_stored_are_left_out_with_the_command_that_stores_them(path):
    db = open_database(path)
    assert beside_newman_of_bodies(db, None, "newman") == (None, ())
    elsewhere = Sea(jonswap(0.5, peak_period=8.0), 0.0)
    none, (said,) = beside_newman_of_bodies(db, elsewhere, "auto")
    assert none is None and said.startswith("left out: the slow force of wave pairs") and "--heading 0" in said
    with pytest.raises(ValueError, match="has no wave pairs towards 0°"):
        beside_newman_of_bodies(db, elsewhere, "body")
