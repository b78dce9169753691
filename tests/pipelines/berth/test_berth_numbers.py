"""What `hakobune.berth` and `hakobune.fender` find, by hand from the formulas of Ueda (1981) and PIANC (2002)."""

import math
import tomllib
from types import SimpleNamespace

import numpy as np
import pytest

import hakobune
from hakobune.bem.time_domain import memory as of_time
from hakobune.mooring.berthing import memory as berthing
from hakobune.pipelines.berth import result
from hakobune.pipelines.common.quantities import StudyError

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


def study_of(text=STUDY, factor=1.0):
    return tomllib.loads(text.replace("ABNORMAL", str(factor)))


def rated_energies(result):
    """J at the rated deflection, of the catalogue and of the softest fender of a batch, which has 0.9 of its reaction
    (Ueda 1981, section 6): its own energy is 0.9 of that, the dolphin's, R²/2k, 0.81"""
    rated, reaction = result["fender.rated_energy"], result["fender.rated_reaction"]
    dolphin = reaction**2 / (2e3 * DOLPHIN)
    return rated, 0.9 * (rated - dolphin) + 0.81 * dolphin


def test_the_energies_of_a_berthing_follow_from_its_sizes():
    """E = ½ C_M M V² C_e C_s C_c times the abnormal factor, C_e = 1/(1 + (l/r)²) with r = L/4; C_M of Ueda
    1 + (π/2) ρd²L/M, Vasco Costa 1 + 2d/B, the older 1 + (π/4) ρd²L/M, PIANC 1.8 to 1.5 for 10 to 50 % of draft under
    the keel."""
    factor = 1.5
    result = hakobune.berth(study_of(factor=factor))
    water = 1.025 * D**2 * L / MASS
    gap = (DEPTH - D) / D  # 35 %
    C_M = {"Ueda 1981": 1 + math.pi / 2 * water, "Vasco Costa": 1 + 2 * D / B}
    C_M |= {"older, (π/4) ρ d² L": 1 + math.pi / 4 * water, "PIANC 2002": 1.8 - 0.3 * (gap - 0.1) / 0.4}
    C_e = 1 / (1 + (OFFSET / (L / 4)) ** 2)
    assert result["approach.eccentricity"] == pytest.approx(C_e, rel=1e-12)
    assert set(result.labels["virtual_mass"].values) == set(C_M)
    for name, mass in C_M.items():
        energy = factor * 0.5 * mass * 1e3 * MASS * SPEED**2 * C_e * 0.9 * 0.95
        assert result[f"method[{name}].C_M"] == pytest.approx(mass, rel=1e-12)
        assert result[f"method[{name}].energy"] == pytest.approx(energy, rel=1e-12)
    chosen = result["method[Ueda 1981].energy"]
    assert result["approach.energy"] == chosen
    used = [result[f"taken[{band}].used"] for band in ("catalogue", "softest of a batch")]
    # of a rated strain that the whole fender has: that of the pair's own energy to the tolerance of its curve
    assert used == pytest.approx([chosen / energy for energy in rated_energies(result)], rel=1e-3)
    assert not result.fails


def test_two_springs_in_a_row_take_the_energy_by_half_of_force_times_way():
    """Ueda (1981): a fender as a spring of its rated reaction at 15 % before a dolphin; R = V √(m k), both share R, and
    the ship rests after a quarter of the period 2π √(m/k)"""
    plain = STUDY.replace("softness = 0.9\nconfiguration = 0.95\n", "")
    result = hakobune.berth(study_of(plain))
    plateau, dolphin = result["fender.rated_reaction"], 1e3 * DOLPHIN
    stiff = plateau / (0.15 * 1.0)
    k = 1 / (1 / stiff + 1 / dolphin)
    m = (1 + math.pi / 2 * 1.025 * D**2 * L / MASS) * 1e3 * MASS / (1 + (OFFSET / (L / 4)) ** 2)
    R = SPEED * math.sqrt(m * k)
    assert plateau > R
    found = [result[f"two_springs.{name}"] for name in ("energy", "reaction", "fender", "dolphin", "rest_time")]
    by_hand = [0.5 * m * SPEED**2, R, R / stiff, R / dolphin, math.pi / 2 * math.sqrt(m / k)]
    assert found == pytest.approx(by_hand, rel=1e-9)


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
def test_a_fender_is_enough_up_to_what_the_softest_of_its_batch_takes_up(speed, enough):
    """E ∝ V²: at 0.99 and 1.01 of the speed that takes all of it; PIANC's virtual mass, which is 1.6125 at 35 %"""
    text = STUDY.replace("offset = 40.0", 'offset = 40.0\nvirtual_mass = "pianc"')
    _, rated = rated_energies(hakobune.berth(study_of(text)))
    C_e = 1 / (1 + (OFFSET / (L / 4)) ** 2)
    full = math.sqrt(2 * rated / (1.6125 * 1e3 * MASS * C_e * 0.9 * 0.95))
    result = hakobune.berth(study_of(text.replace(f"speed = {SPEED}", f"speed = {speed * full:.6f}")))
    assert (not result.fails) is enough


def test_a_makers_table_lies_beside_the_study_wherever_the_command_is_called(tmp_path, monkeypatch):
    """Of a linear table of 1000 kN at 0.5 m: 250 kJ, ½ R δ"""
    (tmp_path / "study").mkdir()
    (tmp_path / "study" / "linear.csv").write_text("deflection_m,reaction_kN\n0,0\n0.25,500\n0.5,1000\n")
    text = STUDY.replace("ABNORMAL", "1.0").replace(f"dolphin = {DOLPHIN}", "rated_strain = 0.5\ncount = 20")
    text = text.replace('family = "v"', 'table = "linear.csv"').replace("length = 20.0\n", "")
    (tmp_path / "study" / "berth.toml").write_text(text)
    monkeypatch.chdir(tmp_path)
    result = hakobune.berth("study/berth.toml")
    assert result["fender.rated_energy"] == pytest.approx(20 * 250e3, rel=1e-9)
    assert result["fender.rated_reaction"] == pytest.approx(20e6, rel=1e-9)


@pytest.mark.parametrize(
    ("mass", "depth", "says"),
    [
        (1.021, 20.0, ["the body of a.h5 displaces 1000 t, but the ship has 1021 t; the ship's mass is used"]),
        (1.019, 20.0, []), (0.981, 19.7, []), (1.0, None, []),
        (1.0, 19.62, []),  # 1.94 %
        (1.0, 19.59, ["the memory of a.h5 is valid for a water depth of 20 m, but depth is 19.59 m"]),  # 2.09 %
        (1.0, 19.5, ["the memory of a.h5 is valid for a water depth of 20 m, but depth is 19.5 m"]),
    ],
)  # fmt: skip
def test_a_memory_of_another_mass_or_depth_is_told_beyond_two_hundredths(monkeypatch, mass, depth, says):
    monkeypatch.setattr(result, "ship_of_database", lambda db, mass, gyration, center: (mass, gyration, center))

    stored = SimpleNamespace(path="a.h5", density=1000.0, water_depth=20.0, bodies=(), displaced_volume=1000.0)
    ship = SimpleNamespace(mass=1e6 * mass, gyration=50.0)
    study = SimpleNamespace(ship=SimpleNamespace(center=1.5, body=""), depth=depth)
    made, told = result._ship(study, SimpleNamespace(ship=ship), stored)
    assert made == (1e6 * mass, 50.0, 1.5) and list(told) == says


def several(*fixed):
    """A database of a pier, a ship and a barge; fixed : names of those that do not move"""
    bodies = tuple(SimpleNamespace(name=name, fixed=name in fixed) for name in ("pier", "ship", "barge"))
    return SimpleNamespace(path="a.h5", density=1000.0, water_depth=20.0, bodies=bodies)


@pytest.mark.parametrize(("fixed", "body", "first", "said"), [
    (("pier",), "barge", 6, ["the memory is that of barge with ship held fixed beside it"]),
    (("pier",), "ship", 0, ["the memory is that of ship with barge held fixed beside it"]),
    (("pier", "ship"), "", 0, []),
])  # fmt: skip
def test_the_ship_is_one_of_several_and_the_others_are_held(monkeypatch, fixed, body, first, said):
    one = SimpleNamespace(name=body or "barge", displaced_volume=1000.0)
    monkeypatch.setattr(result, "body_named", lambda db, name: one if name == one.name else None)
    monkeypatch.setattr(result, "ship_of_database", lambda *given, **more: more["first"])
    ship = SimpleNamespace(mass=1e6, gyration=50.0)
    study = SimpleNamespace(ship=SimpleNamespace(center=0.0, body=body), depth=20.0)
    made, told = result._ship(study, SimpleNamespace(ship=ship), several(*fixed))
    assert made == first and list(told) == said


@pytest.mark.parametrize(("db", "body", "says"), [
    (several("pier"), "", "ship.body is ''; allowed: a body of a.h5 that moves: ship, barge"),
    (several("pier"), "pier", "ship.body is 'pier'; allowed: a body of a.h5 that moves: ship, barge"),
    (SimpleNamespace(path="a.h5", bodies=()), "ship",
     "ship.body is 'ship', but a.h5 contains one body; leave ship.body out"),
])  # fmt: skip
def test_a_ship_that_no_body_is_cannot_berth(db, body, says):
    with pytest.raises(StudyError) as error:
        result._vessel(body, db)
    assert str(error.value) == says


def test_motions_of_the_ship_are_its_sway_and_yaw_among_those_of_all(monkeypatch):
    asked, square = [], np.arange(144.0).reshape(12, 12)
    memory = SimpleNamespace(matrices=(np.eye(1), square[:1], square[:, :1]), added_mass_infinity=square,
                             storage=None, loss=None)  # fmt: skip
    monkeypatch.setattr(of_time, "memory_of_database", lambda db, tolerance, motions: asked.append(motions) or memory)
    ship = berthing.ship_of_database(None, 1e6, 50.0, first=6)
    assert asked == [[7, 11]] and ship.added_mass_infinity.tolist() == [[91.0, 95.0], [139.0, 143.0]]


def test_without_a_database_the_water_has_the_virtual_mass_of_the_study(monkeypatch):
    """C_M − 1 of the mass, at its own radius of gyration"""
    monkeypatch.setattr(result, "without_memory", lambda mass, gyration, added: (mass, gyration, added))
    approach = SimpleNamespace(ship=SimpleNamespace(mass=100.0, gyration=3.0), virtual_mass=1.8)
    (mass, gyration, added), told = result._ship(None, approach, None)
    assert (mass, gyration, told) == (100.0, 3.0, ()) and added == pytest.approx(np.diag([80.0, 720.0]))


@pytest.mark.parametrize("share, told", [(0.68, False), (0.70, True), (0.89, True), (0.91, False)])
def test_the_softest_fender_by_all_causes_is_told_beyond_its_rated_energy(share, told):
    """Factors 0.9 of manufacture, 0.8 of ten repetitions and 0.95 of warmth (SR179 report, 3.4.7): 0.684 of the rated
    energy without a dolphin; beyond 0.9 the batch fails and is told instead"""
    text = STUDY.replace(f"dolphin = {DOLPHIN}\n", "")
    one = hakobune.berth(study_of(text))
    factor = share * one["fender.rated_energy"] / one["approach.energy"]
    found = hakobune.berth(study_of(text, factor)).findings
    soft = [line for line in found if "the softest fender by manufacture, ageing, velocity, repetition" in line]
    assert len(soft) == told and any(line.startswith("FAILS: energy of the berthing") for line in found) == (
        share > 0.9
    )
    for line in soft:
        assert (
            f"needs {100 * share / 0.684:.4g} % of its rated energy, and the softest of a batch needs "
            f"{share / 0.009:.4g} %" in line
        )
    alone = text + 'causes = ["manufacture"]\n'
    assert not [line for line in hakobune.berth(study_of(alone, factor)).findings if "the softest fender by" in line]
