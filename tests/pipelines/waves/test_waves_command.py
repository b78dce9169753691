"""`hakobune waves` and the film of a body in regular waves."""

import numpy as np
import pytest
from PIL import Image

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
    assert "0.8 rad/s" in told and "behind it" in told and "in the body" in told
    x, y, real, imag = np.loadtxt(place, delimiter=",", skiprows=1).T
    assert x.min() == -100 and y.max() == 100 and not np.any((np.abs(x) < 20) & (np.abs(y) < 10))
    assert np.isfinite(real).all() and np.isfinite(imag).all()
    picture = tmp_path / "waves.png"
    assert main([*words, "--fixed", "--output", str(picture)]) == 0 and picture.stat().st_size > 10_000


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
        (["waves", "--heading", "0"], "give --period in s or --omega"),
        (["waves", "--period", "-3"], "allowed: above 0"),
        (["waves", "--omega", "3"], "3"),
        (["waves", "--omega", "0.8", "--at", "1"], "allowed: x,y in m"),
        (["waves", "--omega", "0.8", "--width", "3"], "--width is 3 m"),
        (["waves", "--omega", "0.8", "--output", "map.txt"], "allowed: .png"),
        (["animate", "--omega", "0.8", "--output", "film.gif", "--seed", "1"], "--seed belongs to a simulation"),
        (["animate", "--omega", "0.8", "--output", "film.gif", "--height", "0"], "--height is 0 m"),
        (["animate", "--omega", "0.8", "--output", "film.gif", "--field", "area"], "allowed: pressure"),
        (
            ["animate", "--omega", "0.8", "--output", "film.gif", "--field", "pressure", "--heading", "35"],
            "the pressure is stored at",
        ),
        (["animate", "--output", "film.gif"], "give --period in s or --omega"),
    ],
)
def test_a_wrong_question_gets_one_line(database, tmp_path, monkeypatch, capsys, words, told):
    monkeypatch.chdir(tmp_path)
    assert main([words[0], str(database), *words[1:]]) == 2
    error = capsys.readouterr().err
    assert told in error and error.count("\n") == 1 and not list(tmp_path.iterdir())
