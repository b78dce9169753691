"""The views of a result in a pipe: JSON, CSV and file have its quantities to the bit."""

import json

import hakobune
from hakobune.pipelines.cli import main


def check_views(made, words, place, capsys):
    """made : Result of the function; words : of the command that does the same; place : path of a file to be made"""
    said = {}
    for form in ("json", "csv"):
        capsys.readouterr()
        assert main([*words, f"--{form}"]) == made.status
        said[form] = capsys.readouterr().out
    assert said["csv"] == made.to_csv() and json.loads(said["json"])["quantities"]
    strip = [json.loads(text) | {"provenance": None} for text in (said["json"], made.to_json())]
    assert strip[0] == strip[1]
    made.write(place)
    assert hakobune.read(place) == made
