"""`hakobune fender` as a user calls it."""

import numpy as np
import pytest

from hakobune.pipelines import cli
from hakobune.pipelines.common.fender_tables import FenderTable, fender_of, pair_of


def test_energy_asked_for_is_taken_up_and_drawn(tmp_path, capsys):
    picture = tmp_path / "f.png"
    asked = f"fender --family cell --height 2 --dolphin 14000 --energy 900 --output {picture}"
    assert cli.main(asked.split()) == 0
    table = FenderTable(family="cell", height=2.0, dolphin=14000.0)
    pair = pair_of(table, fender_of(table))
    at = pair.deflection_at_energy(9e5)
    told = capsys.readouterr().out
    assert f"at {at:.4g} m" in told and "900.0 kJ" in told and "× 1.429 (stiffest)" in told
    assert picture.stat().st_size > 10_000


def test_an_inclined_face_is_told_beside_the_upright_one_and_drawn(tmp_path, capsys):
    picture = tmp_path / "f.png"
    asked = f"fender --family cell --height 2 --angle 8 --width 2.4 --energy 900 --output {picture}"
    assert cli.main(asked.split()) == 0
    told = capsys.readouterr().out
    words = {"family": "cell", "height": 2.0}
    tilted, straight = (fender_of(FenderTable(**words, **more)) for more in ({"angle_deg": 8.0, "width": 2.4}, {}))
    share = tilted.rated_energy / straight.rated_energy
    assert f"inclined by 8° over 2.4 m, by strips: × 0.982 on the rated reaction, × {share:.3f}" in told
    assert f"at {tilted.deflection_at_energy(9e5):.4g} m" in told and "energy ×" in told
    assert picture.stat().st_size > 10_000
    of_length = fender_of(FenderTable(family="v", height=1.0, length=2.0, angle_deg=8.0))
    assert of_length.name.endswith("inclined by 8°")


def test_fenders_side_by_side_add():
    one, four = (fender_of(FenderTable(family="v", height=1.0, length=2.5, count=n)) for n in (1, 4))
    x = np.linspace(0, 0.5, 20)
    assert np.allclose(four.reaction(x), 4 * one.reaction(x), rtol=1e-14)


@pytest.mark.parametrize(
    "flags, says",
    [
        ("", "--height requires an argument"),
        ("--height 2", "family and table: neither is given"),
        ("--height 2 --family=", "family '' is unknown"),
        ("--height -2 --family cell", "fender.height is -2; allowed: above 0, at most 20"),
        ("--height 2 --family cell --strain 0.7", "beyond its table, which ends at 1.1 m (55.0 %)"),
        ("--height 2 --family cell --energy 9000", "take a larger fender or give an overload stiffness"),
        ("--height 2 --family cell --energy 9 --strain 0.1", "allowed: one of --strain, --deflection, --energy"),
        ("--height 2 --family cell --dolphin 200", "snaps through"),
        ("--height 2 --table nowhere.csv", "nowhere.csv does not exist"),
        ("--height 2 --family cell --angle 8", "fender.angle_deg is 8 without a width; give it in m"),
        ("--height 2 --family cell --angle 60 --width 2", "inclined by 60°; allowed: 0 to 45"),
        ("--height 2 --family cell --width 2", "fender.width is 2 m without an angle_deg"),
        ("--height 2 --family cell --output f.txt", "has the suffix '.txt'"),
    ],
)
def test_a_wrong_question_is_one_line_and_status_2(flags, says, capsys):
    assert cli.main(["fender", *flags.split()]) == 2
    told = capsys.readouterr()
    assert says in told.err and told.err.count("\n") == 1 and not told.out
