"""`hakobune waves` and the film of a body in regular waves."""

import numpy as np
import pytest
from PIL import Image

import hakobune
from hakobune.pipelines.cli import main


@pytest.fixture(scope="module")
def database(tmp_path_factory):
    place = tmp_path_factory.mktemp("waves") / "box.h5"
    words = "box --length 40 --beam 20 --draft 5 --depth 10 --gyration 6,12,13 --omega 0.8,1.0 --heading 0:180:7"
    assert (
        main(
            [
                *words.split(),
                "--only",
                "added_mass,radiation_damping,excitation_force,kochin,rao,pressure",
                "--output",
                str(place),
            ]
        )
        == 0
    )
    return place


def test_a_body_has_a_map_points_and_a_csv(database, tmp_path, capsys):
    place = tmp_path / "waves.csv"
    words = ["waves", str(database), "--omega", "0.8", "--heading", "35", "--at", "45,0", "--at=0,0"]
    assert main([*words, "--output", str(place), "--width", "200"]) == 0
    told = capsys.readouterr().out
    assert "0.8 │ rad/s" in told and "behind it" in told and "0, 0 m is in the body" in told
    x, y, real, imag = np.loadtxt(place, delimiter=",", skiprows=1).T
    assert x.min() == -100 and y.max() == 100 and not np.any((np.abs(x) < 20) & (np.abs(y) < 10))
    assert np.isfinite(real).all() and np.isfinite(imag).all()
    picture = tmp_path / "waves.png"
    assert main([*words, "--fixed", "--plot", str(picture)]) == 0 and picture.stat().st_size > 10_000


def test_the_places_of_a_result_are_points_of_its_map_and_a_far_point_has_the_height_of_the_waves_that_come(database):
    """What the body sends falls as 1/√r; a file read back is the same, with the phase of the crest, k·x − ωt"""
    found = hakobune.waves(database, omega=0.8, heading=0.0, at=[(-4000.0, 0.0), (45.0, 0.0)])
    grid = np.abs(found["map"])
    assert found["place[highest].height"] == np.nanmax(grid) and found["place[lowest].height"] == np.nanmin(grid)
    assert found["place[-4000, 0 m].height"] == pytest.approx(1.0, abs=0.05)
    k = 2 * np.pi / found["wave.length"]
    assert k * np.tanh(k * 10.0) == pytest.approx(0.8**2 / 9.80665, rel=1e-9)
    held = hakobune.waves(database, omega=0.8, heading=0.0, fixed=True)
    assert held["body"] == "held" and np.isnan(held["body.motion"]).all() and not np.isnan(found["body.motion"]).any()


def test_the_file_of_a_map_is_read_back(database, tmp_path):
    place = tmp_path / "waves.h5"
    words = ["waves", str(database), "--omega", "0.8", "--heading", "35"]
    for _ in range(2):
        assert main([*words, "--output", str(place)]) == 0
    assert hakobune.read(place) == hakobune.waves(database, omega=0.8, heading=np.radians(35.0))


def test_a_film_of_regular_waves_is_one_period(database, tmp_path, monkeypatch):
    monkeypatch.setattr("hakobune.pipelines.films.of_database.FRAMES", 3)
    film = tmp_path / "film.gif"
    words = ["animate", str(database), "--omega", "1.0", "--heading", "90", "--field", "pressure"]
    assert main([*words, "--output", str(film)]) == 0
    with Image.open(film) as frames:
        assert frames.n_frames == 3


@pytest.mark.parametrize(
    "words, told",
    [
        (["waves", "--heading", "0"], "give either period in s or omega"),
        (["waves", "--period", "-3"], "allowed: above 0"),
        (["waves", "--omega", "3"], "3"),
        (["waves", "--omega", "0.8", "--at", "1"], "allowed: x,y in m"),
        (["waves", "--omega", "0.8", "--width", "3"], "width is 3 m"),
        (["waves", "--omega", "0.8", "--output", "map.txt"], "allowed suffixes: .csv"),
        (["animate", "--omega", "0.8", "--output", "film.gif", "--seed", "1"], "--seed belongs to a simulation"),
        (["animate", "--omega", "0.8", "--output", "film.gif", "--height", "0"], "--height is 0 m"),
        (["animate", "--omega", "0.8", "--output", "film.gif", "--field", "area"], "allowed: pressure"),
        (
            ["animate", "--omega", "0.8", "--output", "film.gif", "--field", "pressure", "--heading", "35"],
            "the pressure is stored at",
        ),
        (["animate", "--output", "film.gif"], "give either period in s or omega"),
    ],
)
def test_a_wrong_question_gets_one_line(database, tmp_path, monkeypatch, capsys, words, told):
    monkeypatch.chdir(tmp_path)
    assert main([words[0], str(database), *words[1:]]) == 2
    error = capsys.readouterr().err
    assert told in error and error.count("\n") == 1 and not list(tmp_path.iterdir())
