"""A response study of a barge beside a pier, from its tables to its result."""

import re

import numpy as np
import pytest

import hakobune
from hakobune.bem.database import open_database
from hakobune.bem.drift import harmonics
from hakobune.bem.waves import wavenumber
from hakobune.mooring.response.sea_state import sea_state
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.typed import typed
from hakobune.pipelines.common.weather.seas import sea_with_swell
from hakobune.pipelines.response.study import SeaTable

BARGE = {"name": "barge", "shape": "box", "length": 12.0, "beam": 5.0, "draft": 1.5, "place": [0.0, 4.0, 0.0],
         "gyration": [1.6, 3.6, 3.6]}  # fmt: skip
PIER = {"name": "pier", "shape": "box", "length": 6.0, "beam": 2.0, "draft": 4.0, "place": [1.0, -4.0, 90.0],
        "fixed": True}  # fmt: skip
SEA = {"spectrum": "issc", "height": 0.5, "mean_period": 4.5, "direction_deg": 0.0}
DECK = {"name": "deck", "body": "barge", "position": [0.0, -2.5, 1.0]}
QUAY = {"name": "quay", "body": "pier", "position": [0.0, 0.0, 1.0]}
HOSE = {"name": "hose", "points": ["quay", "deck"]}


@pytest.fixture(scope="module")
def database(tmp_path_factory):
    path = tmp_path_factory.mktemp("several") / "quay.h5"
    waves = {"omegas": {"from": 0.8, "to": 2.2, "count": 6}, "headings_deg": [0.0]}
    hakobune.solve({"water": {"depth": 9.0}, "bodies": [BARGE, PIER], "waves": waves, "panels": 60}, path)
    return path


def test_absolute_and_relative_motion_and_drift_of_each(database):
    """Beside a pier that heads 90° the hose moves along its x as the deck does along y, and along its y against x"""
    found = hakobune.response({"sea": SEA, "points": [DECK, QUAY], "relative": [HOSE], "keel": {}}, database)
    sigma = dict(zip(found.labels["response"].values.tolist(), found["response.sigma"], strict=True))
    assert sigma["barge heave"] > 0 and not any(name.startswith("quay") for name in sigma)
    for hose, deck in zip("xyz", "yxz", strict=True):
        assert sigma[f"hose relative displacement {hose}"] == pytest.approx(sigma[f"deck displacement {deck}"])
    assert list(found.labels["body"].values) == ["barge", "pier"] and np.all(found["drift.of_each.surge"] != 0)
    corners = {f"barge keel x {x:g} y {y:g}" for x in (6, -6) for y in (2.5, -2.5)}  # in axes of the barge
    assert set(found.labels["keel_point"].values) == corners and len(found["keel.left"]) == 4


FAULTS = {
    "of none": ({"points": [{**DECK, "body": "tug"}]}, "points[0].body is 'tug'; allowed: one of barge, pier"),
    "of no body": ({"points": [{**DECK, "body": ""}]}, "points[0].body is ''; allowed: one of barge, pier"),
    "a clearance": ({"points": [{**DECK, "clearance": 1.0}]}, "elevation between hulls is not known"),
    "a pair of what is not there": ({"points": [DECK], "relative": [HOSE]}, "relative[0].points has 'quay'"),
    "a pair of one body": (
        {"points": [DECK, {**DECK, "name": "bow"}], "relative": [{**HOSE, "points": ["deck", "bow"]}]},
        "points are both on barge",
    ),
    "two of a name": ({"points": [DECK], "relative": [{**HOSE, "name": "deck"}]}, "two points are called 'deck'"),
    "a matrix of one": ({"body": {"damping": [[1.0]]}}, "allowed: 6 rows of 6"),
    "viscous": ({"body": {"viscous": {"roll": "Yamashita"}}}, "give damping or damping_ratio"),
    "pairs of waves": ({"sea": {**SEA, "qtf": "bound-wave"}}, 'allowed: "newman"'),
    "another's damping": ({"body": {"damping_ratio": {"roll": 0.1}}}, "allowed: barge surge, barge sway"),
}


@pytest.mark.parametrize("name", FAULTS)
def test_what_several_bodies_cannot_be_asked(database, name):
    more, words = FAULTS[name]
    with pytest.raises(StudyError) as error:
        hakobune.response({"sea": SEA, **more}, database)
    assert words in str(error.value)


SPRINGS = [((6.0, 0.0, 0.4), (26.0, 4.0, 0.4)), ((-6.0, 0.0, 0.4), (-26.0, 4.0, 0.4)),
           ((0.0, 2.5, 0.4), (0.0, 21.5, 0.4)), ((0.0, -2.5, 0.4), (0.0, -13.5, 0.4))]  # fmt: skip
STIFF, PULL = 2e5, 2e4  # N/m, N
MOORING = """[water]
depth = 9.0

[hulls.barge]
freeboard = 1.0

[types.spring]
spring_kN_per_m = 200.0
"""


def moored_by_springs(folder, more=""):
    """A study of four springs at 20 kN, the barge's origin at (0, 4)"""
    text = MOORING
    for i, (fairlead, bollard) in enumerate(SPRINGS):
        text += f'\n[[lines]]\nname = "{i}"\ntype = "spring"\nbody = "barge"\nfairlead = {list(fairlead)}\n'
        away = np.linalg.norm(np.subtract(bollard, fairlead) - [0.0, 4.0, 0.0])
        text += f"bollard = {list(bollard)}\nlength = {float(away - PULL / STIFF)!r}\n"
    path = folder / "springs.toml"
    path.write_text(text + more)
    return path


def by_hand(center):
    """(6, 6) N/m … of the springs about the rotation centre: k n nᵀ + T/d (1 − n nᵀ), and T turning with its arm"""
    K = np.zeros((6, 6))
    for fairlead, bollard in SPRINGS:
        away, arm = np.subtract(bollard, fairlead) - [0.0, 4.0, 0.0], np.subtract(fairlead, center)
        d = np.linalg.norm(away)
        n = away / d
        own = STIFF * np.outer(n, n) + PULL / d * (np.eye(3) - np.outer(n, n))
        cross = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
        G = np.hstack([np.eye(3), -cross])
        K += G.T @ own @ G
        K[3:, 3:] += PULL * (n @ arm * np.eye(3) - np.outer(arm, n))
    return K


def test_bodies_on_their_moorings_move_as_on_the_stiffness_by_hand(database, tmp_path):
    sea = {**SEA, "height": 0.02}  # drift moves nothing
    found = hakobune.response({"sea": sea}, database, moored=moored_by_springs(tmp_path))
    reader = open_database(database).bodies_reader.floating()
    held = reader.restrained(stiffness=by_hand(reader.bodies[0].own_center))
    beside = sea_state(held, sea_with_swell("sea", typed(sea, SeaTable, StudyError), 9.0), 3 * 3600.0)
    sigma = dict(zip(found.labels["response"].values.tolist(), found["response.sigma"], strict=True))
    for name, wanted in zip(beside.names[:6], beside.sigma[:6], strict=True):
        assert sigma[name] == pytest.approx(wanted, rel=1e-4, abs=1e-6 * beside.sigma[:6].max()), name
    free = hakobune.response({"sea": sea}, database)
    assert abs(free["response.sigma"][0] / found["response.sigma"][0] - 1) > 0.05  # springs matter
    assert found.labels["difference"].values[-1] < 1.0  # slow beats, however stiff the springs
    assert list(found.labels["horizontal"].values) == ["barge surge", "barge sway", "barge yaw"]
    assert any("4 lines of" in one and "slow drift of each body" in one for one in found.notes)


@pytest.mark.parametrize(("study", "more", "words"), [
    ({"hinges": [{"name": "h", "bodies": ["pier", "barge"], "position": [0.0, 0.0, 0.0], "kind": "ball"}]}, "",
     "hinges are given with --moored"),
    ({"current": {"speed": 1.0, "direction_deg": 0.0}}, "", "current is given with --moored"),
    ({}, "[hull]\nfreeboard = 1.0\n", "hull is given; allowed with this database: [hulls.barge]"),
])  # fmt: skip
def test_what_bodies_on_their_moorings_cannot_be_asked(database, tmp_path, study, more, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        hakobune.response({"sea": SEA, **study}, database, moored=moored_by_springs(tmp_path, more))


def test_waves_far_from_all_are_those_of_their_kochin_function(database):
    """η = exp(ikx) + √(2/πkr) H(θ) exp(i(kr − π/4)); between the hulls nothing is known"""
    db, w, r = open_database(database), 1.36, 3000.0
    place = r * np.array([np.cos(0.7), np.sin(0.7)])
    found = hakobune.waves(database, omega=w, heading=0.0, at=[place, (0.5, 0.5)])
    k = float(wavenumber(w, 9.0, db.gravity))
    reader = db.bodies_reader
    H = (reader.far_field([w], [0.0])[1] + reader.motions([w], [0.0]) @ reader.far_field([w])[0])[0, 0]
    towards = harmonics(H, db["theta"])
    H = np.sum(towards[1] * np.exp(1j * towards[0] * 0.7))
    exact = np.exp(1j * k * place[0]) + np.sqrt(2 / (np.pi * k * r)) * H * np.exp(1j * (k * r - np.pi / 4))
    height = found["place.height"]
    assert height[-2] == pytest.approx(abs(exact), abs=2e-3) and np.isnan(height[-1])
    assert found.labels["motion"].values[3] == "barge roll" and any(
        "inside their common outline" in one for one in found.notes
    )


CHAIN = {"types": {"spring": {"spring_kN_per_m": 50.0, "breaking_load_kN": 500.0}}, "water": {"depth": 9.0}}
TO_QUAY = {"name": "stern line", "body": "barge", "type": "spring", "fairlead": [-6.0, -2.5, 1.0], "length": 4.0,
           "to": "pier", "bollard": [-1.0, 3.0, 1.0]}  # fmt: skip
ANCHORED = {"name": "breast", "body": "barge", "type": "spring", "fairlead": [0.0, 2.5, 1.0], "length": 20.0,
            "bollard": [0.0, 30.0, 1.0]}  # fmt: skip


def test_a_barge_moored_to_a_pier_lies_between_its_lines(database):
    """At rest by hand: ends (−6, 1.5, 1) on the barge, and of the pier that heads 90° at (1, −4): (−2, −5, 1)"""
    study = {**CHAIN, "hulls": {"barge": {"freeboard": 1.0}}, "lines": [TO_QUAY, ANCHORED]}
    found = hakobune.moor(study, database)
    assert found["anchor.place"] == pytest.approx(np.array([[-2.0, -5.0, 1.0], [0.0, 30.0, 1.0]]))
    assert found["fairlead.place"] == pytest.approx(np.array([[-6.0, 1.5, 1.0], [0.0, 6.5, 1.0]]))
    stretched = np.array([np.hypot(4.0, 6.5) - 4.0, 23.5 - 20.0])
    assert found["tension.at_rest"] == pytest.approx(50e3 * stretched)
    assert found.labels["motion"].values.tolist()[0] == "barge surge"


MOORED = {
    "of what is fixed": (
        {"lines": [{**TO_QUAY, "body": "pier"}]},
        "lines[0].body is 'pier'; allowed: a body that moves",
    ),
    "to itself": (
        {"lines": [{**TO_QUAY, "to": "barge"}]},
        "lines[0].to is 'barge'; allowed: the name of another body, pier",
    ),
    "to no place": ({"lines": [{k: v for k, v in TO_QUAY.items() if k != "bollard"}]}, "lines[0].bollard is missing"),
    "a hull of one": ({"lines": [ANCHORED], "hull": {"freeboard": 1.0}}, "allowed with this database: [hulls.barge]"),
    "fenders": ({"lines": [ANCHORED], "fender": [{"curve": "cell", "y": 1.0}]}, "fender"),
}


@pytest.mark.parametrize("name", MOORED)
def test_what_a_mooring_of_several_cannot_be_asked(database, name):
    more, words = MOORED[name]
    with pytest.raises(ValueError) as error:
        hakobune.moor({**CHAIN, "hulls": {} if "hull" in more else {"barge": {"freeboard": 1.0}}, **more}, database)
    assert words in str(error.value)


def test_a_resonance_that_nothing_but_waves_damps_is_a_warning_and_else_a_note(database):
    """Waves damp roll by less than a tenth of critical; a tenth that is given is what lowers the peak"""

    def told(**more):
        found = hakobune.response({"sea": SEA, **more}, database)
        return ["resonance of barge roll" in " ".join(lines) for lines in (found.findings, found.notes)]

    assert told() == [True, False]
    damped = {f"barge {mode}": 0.1 for mode in ("heave", "roll", "pitch")}
    assert told(body={"damping_ratio": damped}) == [False, True]
