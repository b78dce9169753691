"""`hakobune berth` with fenders that are springs, so that every number of its result is one of a mass on a spring."""

import csv
import math
import tomllib
from pathlib import Path
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest
from by_hand import SOFTEST, STIFFEST, line_of, numbers

import hakobune
from hakobune.mooring import berthing
from hakobune.pipelines.berth import result as berth_result
from hakobune.pipelines.berth.measured import measured
from hakobune.pipelines.common.quay_tables import DolphinTable, QuayFenderTable

L, B, D, DEPTH, MASS, SPEED, OFFSET = 300.0, 50.0, 18.0, 24.0, 220_000.0, 0.12, 40.0  # m, t, m/s
K = 20 * 1000.0  # kN/m: twenty fenders of 2 m, 1000 kN at half the height
C_M = 1.8
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
virtual_mass = {C_M}
"""
FENDER = '[[fender]]\ntable = "linear.csv"\nheight = 2.0\nrated_strain = 0.4\ncount = 20\n'


def written(folder, text):
    (folder / "linear.csv").write_text("strain,reaction_kN\n0,0\n0.25,500\n0.5,1000\n")
    path = folder / "berth.toml"
    path.write_text(text)
    return path


def test_every_number_of_a_berthing_on_a_spring_behind_which_a_dolphin_yields(tmp_path):
    """E = ½ C_M M V² C_e; R = √(2E k'), 1/k' = 1/k + 1/κ; the fender is pressed R/k of its 2 m, the dolphin goes R/κ;
    a fender with f of the reaction has f k; rated at 40 % of the height"""
    kappa = 34000.0
    found = hakobune.berth(written(tmp_path, STUDY + FENDER + f"dolphin = {kappa}\nx = {OFFSET}\n"))
    C_e = 1 / (1 + (OFFSET / (L / 4)) ** 2)
    E = 0.5 * C_M * MASS * SPEED**2 * C_e  # kJ
    by_hand = {"ship.mass": 1e3 * MASS, "ship.block": MASS / (1.025 * L * B * D), "approach.speed": SPEED,
               "approach.offset": OFFSET, "approach.eccentricity": C_e, "approach.virtual_mass": C_M,
               "approach.energy": 1e3 * E}  # fmt: skip
    assert {name: found[name] for name in by_hand} == pytest.approx(by_hand, rel=1e-9)

    def rated(factor):
        return (factor * 0.8 * K) ** 2 * (1 / (factor * K) + 1 / kappa) / 2

    def reaction(energy, factor=1.0):
        return np.sqrt(2 * energy / (1 / (factor * K) + 1 / kappa))

    assert found["fender.rated_energy"] == pytest.approx(1e3 * rated(1.0))
    assert found["fender.rated_reaction"] == pytest.approx(1e3 * 0.8 * K)
    assert found.labels["virtual_mass"].values[0] == "given"
    energy = found["method.energy"] / 1e3
    assert found["method.C_M"][0] == C_M and energy[0] == pytest.approx(E) and len(energy) > 1
    assert energy == pytest.approx(found["method.C_M"] * E / C_M)
    assert found["method.reaction"] == pytest.approx(1e3 * reaction(energy), rel=1e-5)
    assert found["method.strain"] == pytest.approx(reaction(energy) / K / 2, rel=1e-5)
    assert found["method.dolphin"] == pytest.approx(reaction(energy) / kappa, rel=1e-5)
    factor = np.array([1.0, 0.9, 1.1, SOFTEST, STIFFEST])
    assert found["taken.factor"] == pytest.approx(factor)
    assert found["taken.used"] == pytest.approx(E / rated(factor), rel=1e-5)
    assert found["taken.reaction"] == pytest.approx(1e3 * reaction(E, factor), rel=1e-5)
    assert found["taken.strain"] == pytest.approx(reaction(E, factor) / (factor * K) / 2, rel=1e-5)
    assert found["taken.dolphin"] == pytest.approx(reaction(E, factor) / kappa, rel=1e-5)
    assert found.status == 0
    assert not any(name.startswith("two_springs") for name in found)  # Ueda's closed form is of buckling fenders


def test_the_course_on_one_spring_is_a_quarter_of_a_sine(tmp_path, asked, pictures):
    """Of the mass m = C_M M/(1 + (l/r)²) that a force at the contact moves: R = V √(m k) sin ωt, ω = √(k/m), largest
    after π/2ω, ½ m V² into the fender, nothing into waves where no database tells of them; up to then the impulse m V
    has slowed the ship and turned it"""
    path = written(tmp_path, STUDY + FENDER + f"x = {OFFSET}\n")
    asked("berth", path, "--plot", tmp_path / "p.png")
    found = hakobune.berth(path)
    r = L / 4
    m = C_M * MASS / (1 + (OFFSET / r) ** 2)
    omega, R = math.sqrt(K / m), SPEED * math.sqrt(m * K)
    energy = 0.5 * m * SPEED**2
    assert found["method.C_M"][0] == C_M and found["course.virtual_mass"] == pytest.approx(C_M)
    told = [found[f"course.{name}"] for name in ("energy", "largest", "largest_time")]
    assert told == pytest.approx([1e3 * energy, 1e3 * R, math.pi / 2 / omega], rel=2e-3)
    assert found["course.into_waves"] == 0.0 and found["course.ledger"] < 1e-5
    course = {"t": found.labels["time"].values, "reaction_1": found["course.reaction"][:, 0],
              "deflection_1": found["course.deflection"][:, 0], "energy_fenders": found["course.taken"],
              "energy_waves": found["course.lost"]}  # fmt: skip
    course |= {name: found[f"course.{name}"] for name in ("sway_velocity", "yaw", "yaw_velocity")}
    t = course["t"]
    pressed = t <= math.pi / omega
    assert course["reaction_1"][pressed] == pytest.approx(1e3 * R * np.sin(omega * t[pressed]), abs=2e-3 * 1e3 * R)
    assert course["deflection_1"][pressed] == pytest.approx(R / K * np.sin(omega * t[pressed]), abs=2e-3 * R / K)
    taken = 1e3 * energy * np.sin(omega * t[pressed]) ** 2
    assert course["energy_fenders"][pressed] == pytest.approx(taken, abs=2e-3 * 1e3 * energy)
    assert np.all(course["energy_waves"] == 0)
    stopped = (
        np.interp(math.pi / 2 / omega, t, course["sway_velocity"]),
        np.interp(math.pi / 2 / omega, t, course["yaw_velocity"]),
    )
    impulse = m * SPEED  # of the force up to then; C_M M and C_M M r² are what it moves and turns
    assert stopped[0] == pytest.approx(SPEED - impulse / (C_M * MASS), rel=2e-3)
    assert abs(stopped[1]) == pytest.approx(impulse * OFFSET / (C_M * MASS * r**2), rel=2e-3)
    assert course["yaw"][-1] == pytest.approx(np.trapezoid(course["yaw_velocity"], t), rel=1e-3)
    force, deep, energies = pictures[0].axes
    assert [axis.get_ylabel() for axis in pictures[0].axes] == ["reaction, kN", "deflection, m", "energy, kJ"]
    assert energies.get_xlabel() == "time from contact, s"
    assert force.lines[0].get_xydata() == pytest.approx(
        np.stack([t, course["reaction_1"] / 1e3], 1), rel=1e-6, abs=1e-6
    )
    assert deep.lines[0].get_xydata() == pytest.approx(np.stack([t, course["deflection_1"]], 1), rel=1e-6, abs=1e-6)
    drawn = {line.get_label(): line.get_ydata() for line in energies.lines}
    assert drawn["stored and dissipated in fenders"] == pytest.approx(
        course["energy_fenders"] / 1e3, rel=1e-6, abs=1e-6
    )
    assert np.all(drawn["in waves"] == 0)
    assert drawn["kinetic-energy method"][0] == pytest.approx(energy, rel=1e-9)


def test_a_second_fender_behind_the_first_takes_part_when_its_gap_is_closed(tmp_path):
    """Both at midship, 0.1 m apart: up to there ½ k x², then ½ k (x² + (x − 0.1)²) = ½ m V²"""
    text = STUDY.replace(f"offset = {OFFSET}", "offset = 0.0")
    path = written(tmp_path, text + FENDER + "x = 0.0\n" + FENDER + "x = 0.0\ngap = 0.1\n")
    found = hakobune.berth(path)
    # k x² − 0.1 k x + 0.005 k − ½ m V² = 0
    c = 0.005 - 0.5 * C_M * MASS * SPEED**2 / K
    x = (0.1 + math.sqrt(0.01 - 4 * c)) / 2
    both = np.array([x, x - 0.1])
    assert found["met.deflection"] == pytest.approx(both, rel=2e-3)
    assert found["met.strain"] == pytest.approx(both / 2, rel=2e-3)
    assert found["met.reaction"] == pytest.approx(1e3 * K * both, rel=2e-3)
    assert found["course.largest"] == pytest.approx(1e3 * K * (2 * x - 0.1), rel=2e-3)


def test_a_ship_that_comes_at_an_angle_meets_the_fender_ahead_first(tmp_path):
    """Bow nearer above 0: the gap at x is less by x tan α, so that of two fenders that ahead is met first"""
    for angle, first in ((2.0, 60.0), (-2.0, -60.0)):
        text = STUDY.replace(f"offset = {OFFSET}\n", f"angle_deg = {angle}\n")
        path = written(tmp_path, text + FENDER + "x = -60.0\n" + FENDER + "x = 60.0\n")
        found = hakobune.berth(path)
        C_e = 1 / (1 + (first / (L / 4)) ** 2)
        assert (found["approach.offset"], found["approach.eccentricity"]) == pytest.approx((first, C_e))


def test_the_eccentricity_is_of_the_contact_from_the_centre_of_gravity(tmp_path):
    """A fender at x = 40 m of a ship whose centre lies 5 m ahead of midship is met 35 m from it; and the offset of an
    eccentricity is r √(1/C_e − 1), here of a radius of gyration that is given"""
    text = STUDY.replace(f"offset = {OFFSET}\n", "").replace("[approach]", "center = 5.0\n[approach]")
    found = hakobune.berth(written(tmp_path, text + FENDER + "x = 40.0\n"))
    by_hand = 35.0, 1 / (1 + (35 / 75) ** 2)
    assert (found["approach.offset"], found["approach.eccentricity"]) == pytest.approx(by_hand)
    text = STUDY.replace(f"offset = {OFFSET}", "eccentricity = 0.64")
    text = text.replace("[approach]", "gyration = 80.0\n[approach]")
    found = hakobune.berth(written(tmp_path, text + FENDER))
    by_hand = 80.0 * math.sqrt(1 / 0.64 - 1), 0.64
    assert (found["approach.offset"], found["approach.eccentricity"]) == pytest.approx(by_hand)


@pytest.mark.parametrize("share, status", [(0.99, 0), (1.01, 1)])
def test_a_dolphin_fails_above_the_force_at_which_it_yields(tmp_path, asked, share, status):
    """At 1.1 of its reaction the fender pushes √(2E k'), 1/k' = 1/(1.1 k) + 1/κ, as long as the dolphin is elastic"""
    kappa, C_e = 34000.0, 1 / (1 + (OFFSET / (L / 4)) ** 2)
    R = math.sqrt(C_M * MASS * SPEED**2 * C_e / (1 / (1.1 * K) + 1 / kappa))
    dolphin = f"dolphin = {kappa}\ndolphin_yield = {R / share:.3f}\ndolphin_beyond = {kappa / 4}\nx = {OFFSET}\n"
    _, said = asked("berth", written(tmp_path, STUDY + FENDER + dolphin), status=status)
    assert ("FAILS: the stiffest fender of a batch (1.1 times its reaction) pushes with" in said) is bool(status)
    if status:
        pushes, yields = numbers(line_of(said, "pushes with"))[1:3]
        assert yields == pytest.approx(R / share, rel=1e-3) and yields < pushes < R * 1.001


@pytest.mark.parametrize("share, status", [(0.99, 0), (1.01, 1)])
def test_a_fender_in_the_course_in_time_fails_above_what_the_softest_of_its_batch_takes(tmp_path, asked, share, status):
    """The second of two at midship, 0.02 m behind, that is rated at 10 % of its height: ½ 0.9 k 0.2² kJ against
    ½ k x₂², times the factors of the study, which the course in time knows nothing of"""
    limit, k2 = math.sqrt(0.9) * 0.2, K
    x = limit * math.sqrt(share / 1.2) + 0.02  # of the first
    speed = math.sqrt((K * x**2 + k2 * (x - 0.02) ** 2) / (C_M * MASS))
    text = STUDY.replace(f"offset = {OFFSET}", "offset = 0.0\nabnormal = 1.2").replace(
        f"speed = {SPEED}", f"speed = {speed:.8f}"
    )
    second = FENDER.replace("rated_strain = 0.4", "rated_strain = 0.1")
    path = written(tmp_path, text + FENDER + "x = 0.0\n" + second + "x = 0.0\ngap = 0.02\n")
    _, said = asked("berth", path, status=status)
    assert ("FAILS: energy in time of the fender at x = 0 m" in said) is bool(status)


def test_fifty_berthings_have_these_medians_and_quartiles():
    """Of the published energies and sizes, again: E = ½ C_M M V²/(1 + (l/r)²), M in ktonf of g = 9.8, ρ = 1.03 tonf/m³;
    within what cut speeds allow: absorbed between E of V and of V + 1 cm/s"""
    folder = Path(berthing.__file__).parent / "tables"
    text = [line for line in (folder / "field.csv").read_text().splitlines() if not line.startswith("#")]
    ratios = {"older": [], "Ueda 1981": []}
    inside = {"older": [], "Ueda 1981": []}
    for row in csv.DictReader(text):
        keys = ("displacement_ktonf", "length_m", "draft_m", "speed_cm_s", "gyration_m", "offset_m", "absorbed_tonfm")
        if row["doubt"] or not all(row[key] for key in (*keys, "beam_m", "eccentricity")):
            continue
        W, length, draft, v, r, offset, absorbed = (float(row[key]) for key in keys)
        if not absorbed > 0:
            continue
        for name, share in (("older", math.pi / 4), ("Ueda 1981", math.pi / 2)):
            virtual = W + share * 1.03e-3 * draft**2 * length  # ktonf
            effective = 0.5 * virtual * 1e3 / 9.8 * (v / 100) ** 2 / (1 + (offset / r) ** 2)  # tonf m
            ratios[name].append(absorbed / effective)
            inside[name].append(1 <= absorbed / effective <= ((v + 1) / v) ** 2)
    found = measured()
    assert found.notes[0].startswith("50 ships, 100 contacts")
    assert list(found.labels["virtual_mass"].values) == list(ratios)
    for i, (name, values) in enumerate(ratios.items()):
        quartiles = [found[f"ratio.{part}"][i] for part in ("low", "median", "high")]
        assert quartiles == pytest.approx(np.quantile(values, [0.25, 0.5, 0.75]), rel=1e-6)
        assert found["contacts"][i] == len(values)
        assert found["bounded"][i] == pytest.approx(np.mean(inside[name]))


def test_fenders_are_told_as_a_simulation_takes_them():
    """Half a beam of 20 m off midship, the second 0.1 m behind the first; on a dolphin that yields"""
    study = {
        "ship": {"length": 100.0, "beam": 20.0, "draft": 6.0, "block": 0.8},
        "approach": {"speed": 0.1, "eccentricity": 0.5},
        "fender": [
            {"family": "cell", "height": 1.45, "x": 30.0, "dolphin": 2e4, "dolphin_yield": 3e3, "dolphin_beyond": 1e3},
            {"family": "cell", "height": 1.45, "x": -30.0, "gap": 0.1, "count": 2},
        ],
    }
    (line,) = [note for note in hakobune.berth(study).notes if "of a simulation study" in note]
    told = tomllib.loads(line.split(": ", 1)[1].replace("; dolphin", "\ndolphin"))
    assert [one["position"] for one in told["fender"]] == [[30.0, 10.0, 0.0], [-30.0, 10.1, 0.0]]
    first, second = msgspec.convert(told["fender"], list[QuayFenderTable])
    assert (first.height, first.on, second.on, second.count) == (1.45, "dolphin 1", None, 2)
    (dolphin,) = msgspec.convert(told["dolphin"], list[DolphinTable])
    assert (dolphin.stiffness, dolphin.yield_force) == (2e4, 3e3)


@pytest.mark.parametrize("fails, told", [(True, ["energy of the berthing", "energy in time of the fender at x = 20 m"]),
                                         (False, ["energy in time of the fender at x = -20 m",
                                                  "energy in time of the fender at x = 20 m"])])  # fmt: skip
def test_every_fender_is_judged_in_time_but_the_first_one_twice(fails, told, monkeypatch):
    """The first of two that the kinetic-energy method fails already is told once; factors multiply energy in time"""
    asked = []

    def judged(what, energy, table, fender):
        asked.append((what, energy))
        return [what] if "in time" in what or fails else []

    fender = SimpleNamespace(energy=lambda deflection: 1e5 * deflection)
    for name, value in (("fender_of", lambda table: fender), ("beyond_batch", judged),
                        ("softest_and_stiffest", lambda *_: ((fender, fender), (0.9, 1.1))),
                        ("at_deflections", lambda *_: (None, (1e6,))), ("deflection_of", lambda *_: 0.5)):  # fmt: skip
        monkeypatch.setattr(berth_result, name, value)
    approach = SimpleNamespace(first=0, energy=3e5, meetings=[(fender, -20.0, 0.0), (fender, 20.0, 0.0)])
    given = SimpleNamespace(softness=0.9, configuration=0.8, abnormal=1.5)
    table = SimpleNamespace(dolphin_yield=None)
    study = SimpleNamespace(fender=[table, table], approach=given)
    course = SimpleNamespace(deflection=np.array([[0.1, 0.2], [0.4, 0.3]]))
    assert list(berth_result._failures(study, approach, course)) == told
    factor = 0.9 * 0.8 * 1.5 * 1e5
    assert asked[-1][1] == pytest.approx(0.3 * factor) and asked[0] == ("energy of the berthing", 3e5)
    assert len(list(berth_result._failures(study, approach, None))) == fails
    for load, said in ((999.0, True), (1001.0, False)):  # kN at which the dolphin yields, pushed with 1000
        table.dolphin_yield = load
        found = " ".join(berth_result._failures(study, approach, None))
        assert (f"pushes with 1000 kN, and the dolphin yields at {load:g} kN" in found) is said
