"""What `hakobune berth` and `hakobune fender` print, by hand from the formulas of Ueda (1981) and PIANC (2002)."""

import json
import math
import re

import pytest

import hakobune
from hakobune.pipelines import cli

L, B, D, DEPTH, MASS, SPEED, OFFSET = 300.0, 50.0, 18.0, 24.3, 220_000.0, 0.12, 40.0  # m, t, m/s
DOLPHIN = 34000.0  # kN/m
STUDY = f"""
depth = {DEPTH}
[ship]
length = {L}
beam = {B}
draft = {D}
displacement = {MASS}
[approach]
speed = {SPEED}
offset = {OFFSET}
softness = 0.9
configuration = 0.95
abnormal = ABNORMAL
[[fender]]
family = "v"
height = 1.0
length = 20.0
dolphin = {DOLPHIN}
x = 40.0
"""


def run(words, capsys):
    assert cli.main([*words, "--json"]) == 0
    tables, said = capsys.readouterr()
    return json.loads(tables.splitlines()[0]), said


def numbers(pattern, text):
    return [float(n) for n in re.search(pattern, text).groups()]


def rated_energies(title):
    """kJ at the rated deflection, of the catalogue and of the softest fender of a batch, which has 0.9 of its reaction
    (Ueda 1981, section 6): its own energy is 0.9 of that, the dolphin's, R²/2k, 0.81"""
    rated, reaction = numbers(r"rated (\d+) kJ, (\d+) kN", title)
    dolphin = reaction**2 / (2 * DOLPHIN)
    return rated, 0.9 * (rated - dolphin) + 0.81 * dolphin


def test_the_energies_of_a_berthing_follow_from_its_sizes(tmp_path, capsys):
    """E = ½ C_M M V² C_e C_s C_c times the abnormal factor, C_e = 1/(1 + (l/r)²) with r = L/4; C_M of Ueda
    1 + (π/2) ρd²L/M, Vasco Costa 1 + 2d/B, the older 1 + (π/4) ρd²L/M, PIANC 1.8 to 1.5 for 10 to 50 % of draft under
    the keel."""
    path, factor = tmp_path / "berth.toml", 1.5
    path.write_text(STUDY.replace("ABNORMAL", str(factor)))
    table, said = run(["berth", str(path)], capsys)
    water = 1.025 * D**2 * L / MASS
    gap = (DEPTH - D) / D  # 35 %
    C_M = {"Ueda 1981": 1 + math.pi / 2 * water, "Vasco Costa": 1 + 2 * D / B}
    C_M |= {"older, (π/4) ρ d² L": 1 + math.pi / 4 * water, "PIANC 2002": 1.8 - 0.3 * (gap - 0.1) / 0.4}
    C_e = 1 / (1 + (OFFSET / (L / 4)) ** 2)
    assert numbers(r"C_e ([\d.]+)", said) == pytest.approx([C_e], abs=6e-4)
    assert {row["virtual mass"] for row in table["rows"]} == set(C_M)
    for row in table["rows"]:
        mass = C_M[row["virtual mass"]]
        energy = factor * 0.5 * mass * MASS * SPEED**2 * C_e * 0.9 * 0.95  # kJ
        assert float(row["C_M"]) == pytest.approx(mass, abs=6e-4)
        assert float(row["energy kJ"]) == pytest.approx(energy, abs=0.06)
        assert float(row["tonf m"]) == pytest.approx(energy / 9.80665, abs=0.06)
    chosen = factor * 0.5 * C_M["Ueda 1981"] * MASS * SPEED**2 * C_e * 0.9 * 0.95
    rated, soft = rated_energies(table["title"])
    words = r"([\d.]+) kJ: (\d+) % of the rated energy, (\d+) % of that at 0.9 of the reaction, enough"
    assert numbers(words, said) == pytest.approx([chosen, 100 * chosen / rated, 100 * chosen / soft], abs=0.51)


def test_two_springs_in_a_row_take_the_energy_by_half_of_force_times_way(tmp_path, capsys):
    """Ueda (1981): a fender as a spring of its rated reaction at 15 % before a dolphin; R = V √(m k), both share R, and
    the ship rests after a quarter of the period 2π √(m/k)"""
    path = tmp_path / "berth.toml"
    path.write_text(STUDY.replace("ABNORMAL", "1.0").replace("softness = 0.9\nconfiguration = 0.95\n", ""))
    table, said = run(["berth", str(path)], capsys)
    (plateau,) = numbers(r"kJ, (\d+) kN", table["title"])
    stiff = plateau / (0.15 * 1.0)
    k = 1 / (1 / stiff + 1 / DOLPHIN)
    m = (1 + math.pi / 2 * 1.025 * D**2 * L / MASS) * MASS / (1 + (OFFSET / (L / 4)) ** 2)
    R = SPEED * math.sqrt(m * k)
    assert plateau > R
    found = numbers(
        r"springs: ([\d.]+) kJ, (\d+) kN, fender ([\d.]+) m, dolphin ([\d.]+) m, rest after ([\d.]+) s", said
    )
    by_hand = [0.5 * m * SPEED**2, R, R / stiff, R / DOLPHIN, math.pi / 2 * math.sqrt(m / k)]
    for value, hand, last in zip(found, by_hand, (0.06, 1.5, 6e-4, 6e-4, 6e-3), strict=True):
        assert value == pytest.approx(hand, abs=last)


def test_the_curve_of_a_fender_holds_the_energy_under_its_reaction():
    """∫ R dx by the trapezoid's rule over the rows; what comes back is less"""
    curve = hakobune.fender({"family": "v", "height": 1.0, "length": 20.0, "dolphin": DOLPHIN}, energy=2.5e6)
    r, e, back = (curve[f"curve.{name}"] for name in ("reaction", "energy", "returned"))
    x, taken = curve.labels["deflection"].values, 0.0
    for i in range(1, len(x)):
        taken += 0.5 * (r[i] + r[i - 1]) * (x[i] - x[i - 1])
        assert e[i] == pytest.approx(taken, rel=0.03)
        assert 0.5 * e[i] < back[i] < e[i]


@pytest.mark.parametrize("speed, enough", [(0.99, True), (1.01, False)])
def test_a_fender_is_enough_up_to_what_the_softest_of_its_batch_takes_up(speed, enough, tmp_path, capsys):
    """E ∝ V²: at 0.99 and 1.01 of the speed that takes all of it; PIANC's virtual mass, which is 1.6125 at 35 %"""
    path = tmp_path / "berth.toml"
    text = STUDY.replace("ABNORMAL", "1.0").replace("offset = 40.0", 'offset = 40.0\nvirtual_mass = "pianc"')
    path.write_text(text)
    _, rated = rated_energies(run(["berth", str(path)], capsys)[0]["title"])
    C_e = 1 / (1 + (OFFSET / (L / 4)) ** 2)
    full = math.sqrt(2 * rated / (1.6125 * MASS * C_e * 0.9 * 0.95))
    path.write_text(text.replace(f"speed = {SPEED}", f"speed = {speed * full:.6f}"))
    assert cli.main(["berth", str(path)]) == (not enough)
    assert ("NOT enough" in capsys.readouterr().out) is not enough


def test_a_makers_table_lies_beside_the_study_wherever_the_command_is_called(tmp_path, monkeypatch, capsys):
    """Of a linear table of 1000 kN at 0.5 m: 250 kJ, ½ R δ"""
    (tmp_path / "study").mkdir()
    (tmp_path / "study" / "linear.csv").write_text("deflection_m,reaction_kN\n0,0\n0.25,500\n0.5,1000\n")
    text = STUDY.replace("ABNORMAL", "1.0").replace(f"dolphin = {DOLPHIN}", "rated_strain = 0.5\ncount = 20")
    text = text.replace('family = "v"', 'table = "linear.csv"').replace("length = 20.0\n", "")
    (tmp_path / "study" / "berth.toml").write_text(text)
    monkeypatch.chdir(tmp_path)
    table, _ = run(["berth", "study/berth.toml"], capsys)
    assert table["title"].startswith("20 × linear.csv: rated 5000 kJ, 20000 kN")
