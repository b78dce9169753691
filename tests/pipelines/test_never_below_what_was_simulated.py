"""What a study tells as largest, or as used of a strength, is never below what it simulated: one table of studies.

Each row is a function that gives (told, simulated): what the result says, and the largest of what was computed on the
way there, of its records or at both ends.  Runs over seeds and designs made of them, those that are not kept too, are
in `simulate/test_simulate.py`, fenders there and in `simulate/test_quay.py`, snapping breakwaters in
`design/test_worked_designs.py`.  Films have numbers of time alone.
"""

import tomllib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import hakobune
from hakobune import pipelines
from hakobune.mooring.lines.system.equilibrium import held_at, rest
from hakobune.mooring.single_point.in_time import pulls, used_in
from hakobune.pipelines.design.kinds.berth import _steady_of_few
from hakobune.pipelines.design.kinds.numbers import strength
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.simulate.work import anchor_pulls, largest_use

SCENES = Path(pipelines.__file__).parent / "scenes"
BREAKING = 4e6  # N
ROPE = "HMPE 160 mm"
SINGLE_POINT = """
[water]
depth = 50.0
[hull]
length = 100.0
beam = 40.0
draft = 8.0
[mass]
added_surge = 0.1
added_sway = 0.6
added_yaw = 0.4
[attachment]
x = 48.0
[hawser]
length = 25.0
[buoy]
z = -5.0
[types.chain]
weight_N_per_m = 2000.0
breaking_load_kN = 4000.0
[mooring]
type = "chain"
length = 330.0
headings_deg = [0, 90, 180, 270]
pretension_kN = 200.0
[current]
speed = 1.0
incidence_deg = 0.0
sway_damping = 500.0
yaw_damping = 2e6
coefficients = { angles_deg = [0, 45, 90], x = [0.7, 0.5, 0], y = [0, 0.7, 1.0] }
[slewing]
duration = 120.0
offset_deg = 60.0
"""
MOVING = """
anchor = [0.0, 0.0, -60.0]
duration = 16.0
water = { depth = 60.0 }
types = { chain = { catalogue = "R3 studless 76 mm" } }
segments = [{ type = "chain", length = 315.0 }]
[fairlead]
position = [292.0, 0.0, -2.0]
motions = [{ period = 8.0, amplitude = [0.5, 0.0, 0.2] }]
"""
BUOY_UNDER_WATER = """
[water]
depth = 200.0
[hull]
length = 100.0
beam = 50.0
draft = 10.0
freeboard = 10.0
[types.rope]
weight_N_per_m = 80.0
breaking_load_kN = 3000.0
axial_stiffness_kN = 4e4
[[spreads]]
segments = [{ type = "rope", length = 150.0 }, { type = "rope", length = 300.0 }]
bodies = [{ after_segment = 1, mass = 2000.0, volume = 20.0 }]
corner_headings_deg = [45]
pretension_kN = 150.0
"""
QUAKE = {
    "motion": "sway",
    "body": {"mass": 51250.0, "added_mass": 15000.0, "damping": 2000.0},
    "fender": {"table": "fender.csv", "height": 2.0, "count": 3},
    "record": {"file": "record.csv"},
}
FENDER = "strain,reaction_kN\n0,0\n0.125,250\n0.25,500\n0.375,600\n0.5,700\n"
PILE = {"start": [0.0, 0.0, -12.0], "end": [0.0, 0.0, 3.0], "drag": 1.0, "width": 1.2, "shape": "circular"}


def floating_line(folder):
    """A rope lighter than water pulls most at the anchor: at the fairlead less by its lift"""
    found = hakobune.line(type=ROPE, length=500.0, depth=300.0, span=380.0)
    anchor, fairlead = found["anchor.tension"], found["fairlead.tension"]
    assert anchor > 1.001 * fairlead
    return found["used"], anchor / found["breaking_load"]


def moving_line(folder):
    found = hakobune.line_dynamics(tomllib.loads(MOVING))
    record = np.array([found[f"history.{end}"].max() for end in ("fairlead", "anchor")])
    return found["tension.used"], record / found["breaking_load"]


def single_point(folder):
    """Turned by 60° the body swings back and pulls more than at rest"""
    found = hakobune.single_point(tomllib.loads(SINGLE_POINT))
    simulated = found["run.line_tension"].max(axis=0) / BREAKING
    assert np.any(simulated > 1.01 * found["line.tension"] / BREAKING)
    return found["line.used"], simulated


def in_a_sweep(folder):
    vary = [{"key": "slewing.offset_deg", "values": [60.0]}]
    found = hakobune.sweep({"command": "single-point", "study": tomllib.loads(SINGLE_POINT), "vary": vary})
    return found["line.used"][0], single_point(folder)[1]


def shaken(folder):
    t = np.arange(0.0, 20.0, 0.05)
    rows = "".join(f"{at:.2f},{0.08 * np.sin(0.6 * at) ** 3:.6f}\n" for at in t)
    (folder / "record.csv").write_text(f"time_s,acceleration_m_s2\n{rows}")
    (folder / "fender.csv").write_text(FENDER)
    found = hakobune.earthquake(QUAKE)
    told = [found[f"method[record in time].{name}"] for name in ("reaction", "deflection")]
    return told, [np.abs(found[f"course.{name}"]).max() for name in ("reaction", "deflection")]


def members(folder):
    found = hakobune.members({
        "water": {"depth": 12.0}, "wave": {"height": 3.0, "period": 8.0, "direction_deg": 0.0},
        "members": [{"name": "here", **PILE}, {"name": "there", **PILE, "start": [9, 0, -12], "end": [9, 0, 3]}],
    })  # fmt: skip
    parts = [np.linalg.norm(found[f"course.{name}"], axis=-1).max(axis=0) for name in ("force", "moment")]
    return [*found["force.size"], *found["moment.size"]], np.concatenate(parts)


def lines_at_rest(folder):
    """At rest and with a line lost, of which some are of segments: each end against the segment there"""
    found = hakobune.lines(SCENES / "lines_barge.toml", broken=True)
    state, _, losses = found.detail
    told, simulated = [], []
    for at, used in ((state, found["used"]), *zip(losses.values(), found["loss.used"], strict=True)):
        ends = [
            (a / line.segments[0].breaking_load, b / line.segments[-1].breaking_load)
            if hasattr(line, "segments") else (a / line.breaking_load, b / line.breaking_load)
            for line, a, b in zip(at.system.lines, at.lines.tension_a, at.lines.tension_b, strict=True)
        ]  # fmt: skip
        told += np.ravel(used).tolist()
        largest = np.max(ends, axis=1)
        simulated += largest.tolist() if np.ndim(used) else [largest.max()]
    return told, simulated


def below_a_buoy(folder):
    """Of a line in time the pull on the body is recorded; below a buoy under water it pulls more, by hand"""
    made = make_study(tomllib.loads(BUOY_UNDER_WATER))
    system = made.system(made.hull_of({}), np.zeros(3), 1025.0, 9.80665)
    reader = SimpleNamespace(axes_at_rest=np.zeros((1, 6)), rigid=6, modes=())
    body = SimpleNamespace(system=system, berth=SimpleNamespace(ropes=()), reader=reader)
    (hull,) = system.bodies
    at = rest(held_at(system, {hull.name: hull.position})).lines
    found = largest_use(body, np.zeros((1, 6)), at.tension_b[None])
    lift, rope = (1025.0 * 20.0 - 2000.0) * 9.80665, 80.0 * 300.0
    still = anchor_pulls(body, np.zeros((1, 6)), at.tension_b[None])
    assert still[:, :2] == pytest.approx(np.column_stack([at.horizontal_a, -at.vertical_a]))
    pulled = anchor_pulls(body, np.zeros((1, 6)), 1.5 * at.tension_b[None])
    assert np.all(pulled[:, 0] > 1.4 * still[:, 0])  # of nearly all of the tension, without the weight
    below = np.hypot(at.horizontal_b, at.vertical_b - rope + lift)
    assert np.all(below > 1.2 * at.tension_b)
    return found, below / 3e6


STUDIES = floating_line, moving_line, single_point, in_a_sweep, shaken, members, lines_at_rest, below_a_buoy


@pytest.mark.parametrize("study", STUDIES, ids=lambda one: one.__name__)
def test_what_is_told_is_never_below_what_was_simulated(study, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told, simulated = map(np.ravel, study(tmp_path))
    assert told.shape == simulated.shape and np.all(simulated > 0)
    assert np.all(told >= simulated * (1 - 1e-6)), (told, simulated)


@pytest.mark.parametrize("place", ["at rest", "in the limit cycle", "in the run in time"])
def test_a_single_point_takes_the_largest_wherever_it_is(place):
    """Of two lines of 4 MN and a hawser of 3 MN that pull with 1 MN, and with 2 MN in one of three places"""
    pull = {one: 2e6 if one == place else 1e6 for one in ("at rest", "in the limit cycle", "in the run in time")}
    rest, cycle, run = (np.array([value]) for value in pull.values())
    lines = SimpleNamespace(tension=np.full(2, rest[0]), lines=SimpleNamespace(utilisation=np.full(2, rest[0] / 4e6)))
    system = SimpleNamespace(breaking_load=np.array([4e6, 4e6]))
    best = SimpleNamespace(hawser=rest, lines=lines, point=SimpleNamespace(system=system))
    records = [SimpleNamespace(hawser=np.array([[0.0], one]), lines=np.array([[0.0, 0.0], [one[0]] * 2]))
               for one in (cycle, run)]  # fmt: skip
    places = pulls(best, records[0], SimpleNamespace(record=records[1], drifts=False))
    largest = [np.max(part, axis=0).tolist() for part in zip(*places.values(), strict=True)]
    assert largest == [[2e6], [2e6, 2e6]]
    used = used_in(places, best, 3e6)
    assert np.max(list(used.values()), axis=0) == pytest.approx([2 / 3, 0.5, 0.5])


@pytest.mark.parametrize("kept, told", [(3, False), (2, True)])
def test_steady_strains_of_fewer_records_than_runs_are_told(kept, told):
    said = list(_steady_of_few({"deflection": np.zeros((kept, 5, 1)), "seed": np.arange(3)}))
    assert bool(said) is told and (not told or ("come from 2 of 3 runs" in said[0] and "keep_series = 3" in said[0]))


def test_a_design_judges_by_what_is_used_where_that_is_more_than_the_pull_on_the_body_says():
    """Pulls of 100 kN on lines of 400 kN: half used below a buoy, a quarter, unknown, beyond reach"""
    found = strength(np.full(4, 4e5), np.array([1e5, 1e5, 1e5, np.inf]), np.array([0.5, 0.25, np.nan, np.inf]))
    assert found == pytest.approx([2e5, 4e5, 4e5, 4e5])
