"""`hakobune sections` of sections side by side: the shipped barges, what a study must not say, and files."""

import tomllib
from pathlib import Path

import pytest

import hakobune
from hakobune.pipelines.cli import main
from hakobune.pipelines.keys.kinds import SCENES

HINGED = SCENES / "sections_hinged.toml"


def tables(**changes):
    raw = tomllib.loads(HINGED.read_text(encoding="utf-8")) | {"omegas": [0.5]}
    return raw | changes


def test_the_shipped_barges_by_the_command(tmp_path, capsys):
    out = tmp_path / "barges.h5"
    assert main(["sections", str(HINGED), "--output", str(out)]) == 0
    assert "0.8329" in capsys.readouterr().out
    result = hakobune.read(out)
    assert result["waves.transmission"][1] == pytest.approx(0.832, rel=2e-3)
    assert result["left.motion"].shape == (3, 3) and result["hinge.sway"].shape == (1, 3)


def test_a_fixed_section_has_no_motion_and_the_order_does_not_matter():
    raw = tables(hinges=[])
    raw["sections"] = raw["sections"][::-1]
    raw["sections"][0] |= {"fixed": True}
    made = hakobune.sections(raw)
    assert "right.motion" not in made and made["gap.gain"].shape == (1, 1)


SECTION = {"name": "left", "beam": 30.0, "draft": 6.0, "y": -16.5}


@pytest.mark.parametrize("changes, says", [
    ({"omegas": []}, "omegas has 0 values; allowed: 1 to 1000, rising"),
    ({"omegas": [0.5, 0.5]}, "omegas has 2 values; allowed: 1 to 1000, rising"),
    ({"damping": 11.0}, "damping is 11; allowed: 0 to 10"), ({"damping": -0.1}, "damping is -0.1; allowed: 0 to 10"),
    ({"water": {"depth": -12.0}}, "water.depth is -12; allowed: above 0"),
    ({"water": {"depth": 12.0, "density": 0.0}}, "water.density is 0; allowed: 900 to 1300"),
    ({"water": {"depth": 12.0, "gravity": float("nan")}}, "water.gravity is nan; allowed: above 0"),
    ({"omegas": [0.0, 0.5]}, "omegas is 0; allowed: above 0"),
    ({"sections": [SECTION, SECTION], "hinges": []}, "sections have the name 'left'"),
    ({"sections": [SECTION | {"draft": 12.0}], "hinges": []}, "sections[0].draft is 12 m in water 12 m deep"),
    ({"sections": [SECTION, SECTION | {"name": "b", "y": 0.0}], "hinges": []}, "m; leave a gap between them"),
    ({"hinges": [{"sections": ["left", "up"], "position": [0, 0]}]}, "hinges[0].sections has 'up'"),
    ({"hinges": [{"sections": ["left", "left"], "position": [0, 0]}]}, "hinges[0] joins left to itself"),
    ({"hinges": [{"sections": ["left", "right"], "position": [0, 0], "kind": "ball"}]},
     "hinges[0].kind is 'ball'; allowed: hinge, rigid"),
])  # fmt: skip
def test_what_a_study_must_not_say(changes, says):
    with pytest.raises(ValueError) as told:
        hakobune.sections(tables(**changes))
    assert says in str(told.value) and "\n" not in str(told.value)


def test_flags_of_the_table_are_refused_beside_a_study(capsys):
    assert main(["sections", str(HINGED), "--xi", "0.5"]) == 2
    assert "--xi is given" in capsys.readouterr().err
    assert not Path("barges.h5").exists()
