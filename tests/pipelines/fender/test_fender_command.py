"""`hakobune fender` as a user calls it."""

import numpy as np
import pytest

import hakobune
from hakobune.pipelines import cli
from hakobune.pipelines.common.fender_tables import FenderTable, fender_of


def test_energy_asked_for_is_taken_up_and_drawn(tmp_path, capsys):
    """By the fender, its softest and its stiffest, each at the deflection where its own energy is that asked for; their
    factors are products of the bands of the SR179 report (1982), 3.4.7"""
    picture = tmp_path / "f.png"
    asked = (
        f"fender --family cell --height 2 --dolphin 14000 --energy 900 --plot {picture} --output {tmp_path / 'f.h5'}"
    )
    assert cli.main(asked.split()) == 0
    table = {"family": "cell", "height": 2.0, "dolphin": 14000.0}
    result = hakobune.fender(table, energy=9e5)
    pair, bands = result.detail.pair, result.detail.bands
    energies = [one.energy(x) for one, x in zip((pair, *bands), result["taken.deflection"], strict=True)]
    assert energies == pytest.approx([9e5] * 3, rel=1e-12) and result["asked.energy"] == energies[0]
    assert hakobune.read(tmp_path / "f.h5")["taken.deflection"].tolist() == result["taken.deflection"].tolist()
    assert result["factor"] == pytest.approx([1, 0.9 * 0.8 * 0.95, 1.1 * 1.05 * 1.1 * 0.9 * 1.25], rel=1e-12)
    shown = f"{result['taken[catalogue].deflection']:.4g}"
    assert shown in capsys.readouterr().out and picture.stat().st_size > 10_000


def test_an_inclined_face_is_told_beside_the_upright_one_and_drawn(tmp_path, capsys):
    picture = tmp_path / "f.png"
    asked = f"fender --family cell --height 2 --angle 8 --width 2.4 --energy 900 --plot {picture}"
    assert cli.main(asked.split()) == 0
    assert (
        "the face is inclined by 8° over 2.4 m and computed in strips; deflections are given" in capsys.readouterr().out
    )
    words, tilted = {"family": "cell", "height": 2.0}, {"angle_deg": 8.0, "width": 2.4}
    found, upright = hakobune.fender(words | tilted, energy=9e5), hakobune.fender(words)
    for name in ("reaction", "energy"):
        share = found[f"rated[catalogue].{name}"] / upright[f"rated[catalogue].{name}"]
        assert found[f"inclined.{name}"] == pytest.approx(share, rel=1e-12)
        # both tables end at the same deflection
        last = found[f"curve.{name}"][1:] / upright[f"curve.{name}"][1:]
        assert found[f"curve.{name}_share"][1:] == pytest.approx(last, rel=1e-9)
    assert found["inclined.energy"] < 0.9 and picture.stat().st_size > 10_000
    of_length = fender_of(FenderTable(family="v", height=1.0, length=2.0, angle_deg=8.0))
    assert of_length.name.endswith("inclined by 8°")


def test_a_fender_of_a_model_has_the_strains_of_the_one_at_sea():
    """Froude: R ∝ λ², E ∝ λ³ of similar fenders at equal strain"""
    large, small = (hakobune.fender({"family": "cell", "height": h}, strain=0.3) for h in (2.0, 2.0 / 70))
    assert small["curve.reaction"] == pytest.approx(large["curve.reaction"] / 70**2, rel=1e-12)
    assert small["curve.returned"] == pytest.approx(large["curve.returned"] / 70**3, rel=1e-9, abs=1e-12)
    assert small["taken.strain"] == pytest.approx(large["taken.strain"], rel=1e-12)


def test_fenders_side_by_side_add():
    one, four = (fender_of(FenderTable(family="v", height=1.0, length=2.5, count=n)) for n in (1, 4))
    x = np.linspace(0, 0.5, 20)
    assert np.allclose(four.reaction(x), 4 * one.reaction(x), rtol=1e-14)


@pytest.mark.parametrize(
    "flags, says",
    [
        ("", "--height is missing"),
        ("--height 2", "family and table: neither is given"),
        ("--height 2 --family=", "family '' is unknown"),
        ("--height -2 --family cell", "fender.height is -2; allowed: above 0, at most 20"),
        ("--height 2 --family cell --strain 0.7", "beyond its table, which ends at 1.1 m (55.0 %)"),
        ("--height 2 --family cell --energy 9000", "kJ; choose a larger fender or give an overload stiffness"),
        ("--height 2 --family cell --energy 9 --strain 0.1", "strain and energy are given; give one of"),
        ("--height 2 --family cell --dolphin 200", "becomes unstable"),
        ("--height 2 --table nowhere.csv", "nowhere.csv does not exist"),
        ("--height 2 --family cell --angle 8", "fender.angle_deg is 8 without a width; give the width of the panel, m"),
        ("--height 2 --family cell --angle 60 --width 2", "inclined by 60°; allowed: 0 to 45"),
        ("--height 2 --family cell --width 2", "fender.width is 2 m but angle_deg is missing;"),
        ("--height 2 --family cell --plot f.txt", "has the suffix '.txt'"),
    ],
)
def test_a_wrong_question_is_one_line_and_status_2(flags, says, capsys):
    assert cli.main(["fender", *flags.split()]) == 2
    told = capsys.readouterr()
    assert says in told.err and told.err.count("\n") == 1 and not told.out
