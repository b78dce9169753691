"""A barge that bends, through the file of a simulation: shapes and loads along it beside the frequency domain."""

import h5py
import numpy as np
import pytest

import hakobune
from hakobune.bem.database import open_database
from hakobune.bem.hinges import Link, rows_of
from hakobune.bem.time_domain.memory import memory_of_database
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.response.points import Station, transfer_functions
from hakobune.mooring.studies.conditions import Waves
from hakobune.pipelines.moor.study import make_study
from hakobune.pipelines.simulate.work import Task, prepared

BARGE = {"shape": "box", "length": 24.0, "beam": 6.0, "draft": 1.2, "gyration": [1.9, 7.0, 7.2],
         "center_of_gravity": [0.0, 0.0, 0.3]}  # fmt: skip
MODES = [{"kind": "vertical bending", "count": 2, "EI": 4e7, "damping": 0.02, "axis_height": -0.2},
         {"kind": "torsion", "count": 1, "GJ": 5e7, "damping": 0.02}]  # fmt: skip
SPRING = {"surge": 40.0, "sway": 40.0, "yaw": 4000.0}  # kN/m, kN m
STUDY = {
    "water": {"depth": 9.0},
    "waves": {"height": 0.02, "period": 4.0, "direction_deg": 45.0, "method": "regular_wave"},
    "simulation": {"duration": 80.0, "ramp": 80.0, "step": 0.2, "memory": "constant", "slow_drift": "none",
                   "tolerance": 1e-4, "spring": SPRING,
                   "linear_damping": {"surge": 40.0, "sway": 40.0, "roll": 300.0, "yaw": 1600.0},
                   "stations": [{"x": [-6.0, 0.0]}]},
}  # fmt: skip
CHAIN = {"weight_kg_per_m": 20.0, "axial_stiffness_tonf": 5000.0, "breaking_load_tonf": 40.0}
ON_CHAINS = {"types": {"chain": CHAIN}, "spreads": [
    {"type": "chain", "length": 50.0, "corner_headings_deg": [45], "pretension_tonf": 1.0}]}  # fmt: skip
SHORT = {"duration": 10.0, "ramp": 2.0, "memory": "constant"}


@pytest.fixture(scope="module")
def barge(tmp_path_factory):
    path = tmp_path_factory.mktemp("beam") / "barge.h5"
    waves = {"omegas": {"from": 1.0, "to": 2.2, "count": 5}, "headings_deg": list(range(0, 360, 45))}
    hakobune.solve({"water": {"depth": 9.0}, "bodies": [BARGE], "modes": MODES, "waves": waves, "panels": 120}, path)
    return path


@pytest.fixture(scope="module")
def run(barge, tmp_path_factory):
    path = tmp_path_factory.mktemp("beam") / "run.h5"
    return hakobune.simulate(STUDY, barge, path), path


def test_shapes_and_loads_in_a_regular_wave_are_those_of_the_frequency_domain(run, barge):
    """√2 σ for a wave of 1 cm on the same springs, of what `response` has of motions and stations

    A record of 20 periods has both of its ends, which is 1e-3 of σ.
    """
    made, _ = run
    body, w = open_database(barge).bodies_reader.floating(), 2 * np.pi / 4.0
    held, drag = np.zeros((2, 9, 9))  # springs, dampers
    for i, word in ((0, "surge"), (1, "sway"), (3, "roll"), (5, "yaw")):
        drag[i, i] = 1e3 * STUDY["simulation"]["linear_damping"][word]
        held[i, i] = 1e3 * SPRING.get(word, 0.0)
    stations = [Station(f"x {x:g}", x) for x in (-6.0, 0.0)]
    held = body.restrained(damping=drag, stiffness=held)
    found = transfer_functions(held, np.array([w]), [np.pi / 4], stations, water=False)
    exact = dict(zip(found.names, 0.01 * np.abs(found.value[0, 0]), strict=True))
    for kind, most in (("record", 9), ("station", 20)):
        names, sigma = made.labels[kind].values[:most].tolist(), made[f"{kind}.sigma"][:most]
        size = {unit: max(exact[name] for name, u in zip(names, units_of(made, kind), strict=False) if u == unit)
                for unit in set(units_of(made, kind)[:most])}  # fmt: skip
        for name, value, unit in zip(names, sigma, units_of(made, kind), strict=False):
            assert np.sqrt(2) * value == pytest.approx(exact[name], abs=2e-3 * size[unit]), name
        assert len(names) >= 9


def units_of(made, kind):
    return made.quantities[f"{kind}.sigma"].unit


def test_the_file_names_shapes_and_stations(run):
    made, path = run
    words = ["vertical bending 1", "vertical bending 2", "torsion 1"]
    assert made.labels["record"].values[6:9].tolist() == words
    assert not any("drift forces on the shapes" in line for line in made.first)  # none are asked for
    with h5py.File(path) as file:
        assert file["dof"].asstr()[()][6:].tolist() == ["vertical_bending_1", "vertical_bending_2", "torsion_1"]
        assert file["motion"].shape[2] == 9 and file["slow_dof"].shape == (3,)
        names = file["station"].asstr()[()].tolist()
        assert names[:3] == ["x -6 vertical deflection", "x -6 vertical bending moment", "x -6 vertical shear force"]
        bent, loads = file["motion"][0, :, 6:8].astype(float), file["loads"][0].astype(float)
        assert loads.shape == (len(bent), len(names))
        middle = names.index("x 0 vertical deflection")
        assert loads[:, middle] == pytest.approx(
            bent[:, 0] * -0.6078, rel=1e-3, abs=1e-9
        )  # w of the first at the middle


def test_chains_bend_it_and_what_is_left_out_comes_first(barge, tmp_path):
    """Mean drift on shapes, and the motion of chains; by default the middle of the beam is told"""
    simulation = SHORT | {"slow_drift": "mean"}
    study = {"water": {"depth": 9.0}, "waves": STUDY["waves"], "simulation": simulation, **ON_CHAINS}
    made = hakobune.simulate(study, barge, tmp_path / "run.h5")
    assert made.first[0].startswith("left out: mean and slow drift forces on the shapes of bodies that bend")
    assert any("static shape" in line and "type chain has no mass" in line for line in made.first)
    assert set(made.labels["station"].values) >= {"x 0 vertical bending moment", "x 0 torsional moment"}
    body = prepared(Task(make_study(study), str(barge), None, None))[0]
    assert body.start[6] < 0 or body.start[6] > 0
    pushed = dict(zip(made.labels["record"].values, made["record.mean"], strict=True))
    assert pushed["vertical bending 1"] == pytest.approx(body.start[6], rel=0.05)


def test_a_shape_alone_swings_freely_at_its_own_frequency(barge, tmp_path):
    """x₀ e^{−dt} (cos pt + d/p sin pt) with mass, added mass and damping at 3 s, stiffness of structure and water"""
    simulation = {"duration": 12.0, "ramp": 0.0, "step": 0.1, "memory": "constant", "constant_period": 3.0,
                  "motions": ["vertical bending 1"], "offset": {"vertical bending 1": 0.02},
                  "tolerance": 1e-5}  # fmt: skip
    hakobune.simulate({"water": {"depth": 9.0}, "simulation": simulation}, barge, tmp_path / "run.h5")
    body = open_database(barge).bodies_reader
    (A,), (B,) = (one[:, 6, 6] for one in body.coefficients(np.array([2 * np.pi / 3])))
    mass, d = body.inertia[6, 6] + A, 0.5 * (body.damping[6, 6] + B) / (body.inertia[6, 6] + A)
    p = np.sqrt(body.stiffness[6, 6] / mass - d**2)
    with h5py.File(tmp_path / "run.h5") as file:
        t, bent = file["time"][()], file["motion"][0].astype(float)
        assert "fixed at rest, as set by simulation.motions" in file.attrs["told"]
        assert "drift forces on the shapes" not in file.attrs["told"]  # there are no waves
    exact = 0.02 * np.exp(-d * t) * (np.cos(p * t) + d / p * np.sin(p * t))
    assert np.abs(bent[:, 6] - exact).max() < 1e-4 * 0.02 and p * 12 > 24 and not bent[:, :6].any()


def test_the_memory_of_all_motions_bends_it_as_the_stored_coefficients_do(tmp_path):
    """Within what the memory says of itself, at a frequency between stored ones; energy goes out of every motion"""
    path = tmp_path / "band.h5"
    waves = {"omegas": {"from": 0.3, "to": 4.0, "count": 20}, "headings_deg": list(range(0, 360, 45))}
    hakobune.solve({"water": {"depth": 9.0}, "bodies": [BARGE], "modes": MODES, "waves": waves, "panels": 160}, path)
    body = open_database(path).bodies_reader.floating()
    memory, w = memory_of_database(body, 1e-2), 1.47
    assert [group for group in memory.groups if 6 in group] == [(2, 6)]
    assert np.linalg.eigvalsh(memory.transform(np.linspace(0.1, 8.0, 60)).real).min() > -1e-6 * memory.damping(w).max()
    drag, springs, T = 0.1 * body.inertia, np.zeros((9, 9)), 2 * np.pi / w
    springs[[0, 1, 5], [0, 1, 5]] = 4e4, 4e4, 4e6
    held = moored(body, memory=memory, spring=springs, damping=drag)
    weather, how = Weather(regular=Waves(0.002, T, 0.6)), Settings(24 * T, 20 * T, T / 20, slow_drift="none")
    run = simulate(held, weather, how)
    exact = body.restrained(damping=drag, stiffness=springs).motions(np.array([w]), [0.6])[0, 0]
    late = run.time >= 20 * T
    turn = np.exp(1j * w * (run.time[late] + 20 * T))
    found = 2 * np.mean(run.motion[late][:-1] * turn[:-1, None], axis=0) / 0.001
    off = np.abs(found - exact)
    allowed = memory.error.max() + memory.deviation.max()
    for kind in (slice(0, 3), slice(3, 6), slice(6, 8), slice(8, 9)):
        assert off[kind].max() < allowed * np.abs(exact[kind]).max(), kind


@pytest.mark.parametrize(
    ("simulation", "more", "words"),
    [
        ({"stations": [{"x": [13.0]}]}, {}, r"simulation.stations\[0\].x has 13; allowed: -12 to 12, the beam"),
        ({"stations": [{"x": [0.0], "body": "tug"}]}, {}, r"stations\[0\].body is 'tug'; allowed: no key body"),
        ({"offset": {"vertical bending 3": 0.1}}, {}, "there is no motion 'vertical bending 3'; allowed: surge,"),
        ({"dynamic_lines": "all"}, ON_CHAINS, "dynamic_lines: type chain of line .* has no mass; give a type with a"),
        ({"qtf": "full"}, {"waves": {"height": 0.5, "period": 4.0, "direction_deg": 45.0, "spectrum": "issc"}},
         "simulation.qtf is 'full' with bodies that bend; allowed"),
    ],
)  # fmt: skip
def test_what_there_is_not_for_a_beam_is_refused_in_a_line(barge, tmp_path, simulation, more, words):
    study = {"water": {"depth": 9.0}, "waves": STUDY["waves"], "simulation": SHORT | simulation, **more}
    with pytest.raises(ValueError, match=words) as caught:
        hakobune.simulate(study, barge, tmp_path / "run.h5")
    assert "\n" not in str(caught.value)


def test_chains_with_a_mass_move_by_themselves_where_a_trial_asks_for_it_or_the_study(barge, tmp_path):
    """In a small sea they pull as in their static shape, but for a tenth of what varies"""
    chains = ON_CHAINS | {"types": {"chain": CHAIN | {"mass_kg_per_m": 23.0, "diameter": 0.06}}}
    found = []
    for how in ("auto", "all", "none"):
        study = {
            "water": {"depth": 9.0},
            "waves": STUDY["waves"],
            "simulation": SHORT | {"dynamic_lines": how},
            **chains,
        }
        found.append(hakobune.simulate(study, barge, tmp_path / f"{how}.h5"))
    chosen, moving, still = found
    assert any(line.startswith('dynamic_lines = "auto": in a trial of 10 s') for line in (*chosen.first, *chosen.notes))
    assert moving["tension.mean"] == pytest.approx(still["tension.mean"], rel=0.03)
    assert not np.array_equal(moving["tension.mean"], still["tension.mean"])


def test_a_ball_holds_the_point_of_a_beam_that_its_shapes_move(barge, tmp_path):
    ball = {"name": "B", "bodies": ["space", "body"], "position": [6.0, 1.0, 0.5], "kind": "ball"}
    hakobune.simulate(STUDY | {"hinges": [ball]}, barge, tmp_path / "run.h5")
    body = open_database(barge).bodies_reader.floating()
    with h5py.File(tmp_path / "run.h5") as file:
        motion, links = file["motion"][0].astype(float), file["links"][0]
    moves = rows_of(body, Link("B", ("space", "body"), tuple(ball["position"]), kind="ball"))
    size = np.abs(motion[:, 6:]).max() + np.abs(motion[:, :3]).max()
    assert np.abs(motion[:, 6]).max() > 1e-4 and np.abs(links[:, :3]).max() > 1e2
    assert np.abs(motion @ moves.T).max() < 2e-3 * size


DOWN = [{"name": f"down {x:g}", "type": "spring", "fairlead": [x, 0.0, 0.0], "bollard": [x, 0.0, -8.0], "length": 7.0}
        for x in (11.0, -11.0)]  # fmt: skip
ON_SPRINGS = {"water": {"depth": 9.0}, "types": {"spring": {"spring_kN_per_m": 60.0}}, "lines": DOWN}


def test_springs_at_both_ends_bend_a_beam_in_moor_as_by_hand(barge):
    """Heave z and the first shape ξ of two springs k, stretched by s: C (z, ξ) = −Σ k (s + z + w ξ) (1, w)"""
    body, k, s = open_database(barge).bodies_reader, 60e3, 1.0
    shape = body.modes[0].shape
    found = hakobune.moor(ON_SPRINGS, barge)
    both = np.array([1.0, shape.along(11.0)])
    C = body.stiffness[np.ix_([2, 6], [2, 6])]
    z, xi = np.linalg.solve(C + 2 * k * np.outer(both, both), -2 * k * s * both)
    made = found.detail[0]
    told = dict(zip(found.labels["bend"].values, found["bend.at_rest"], strict=True))
    assert made.rest.position[0, 2] == pytest.approx(z, rel=1e-4) and abs(z) > 0.05
    assert told["vertical bending 1"] == pytest.approx(xi, rel=1e-4) and abs(xi) > 1e-3
    assert told["x 0 vertical deflection"] == pytest.approx(xi * shape.along(0.0), rel=1e-4)
    assert told["x 0 vertical bending moment"] == pytest.approx(xi * shape.loads(0.0)[0], rel=1e-4)
    pull = k * (s + both @ [z, xi])
    assert found["tension.at_rest"] == pytest.approx([pull, pull], rel=1e-4)
    share = np.linalg.solve(C, both) @ both  # m/N of both ends
    assert made.stiffness[6, 6] == pytest.approx(2 * k * both[1] ** 2, rel=0.02) and share > 0
    assert found["bend.steady"] == pytest.approx(found["bend.at_rest"], abs=1e-9 * abs(xi))


def test_shapes_move_fairleads_in_moor_and_hinges_are_refused(barge):
    """At (12, 3, 0) upward: heave, 3 roll, 12 pitch, both bending shapes and 3 m of twist, each at its largest"""
    waves = {"height": 0.1, "period": 4.0, "direction_deg": 45.0, "method": "regular_wave"}
    study = {"water": {"depth": 9.0}, "waves": waves, **ON_CHAINS}
    found = hakobune.moor(study, barge)
    a, shapes = found["motion.amplitude"], [mode.shape for mode in open_database(barge).modes]
    lever = np.array([1.0, 3.0, 12.0, *(abs(one.along(12.0)) for one in shapes[:2]), 3.0 * abs(shapes[2].along(12.0))])
    assert a[6] > 0.05 * a[2] > 0 and len(found["period.at_rest"]) == 9
    assert found["fairlead.upward"][0] == pytest.approx(
        lever @ a[[2, 3, 4, 6, 7, 8]] * found["motion_factor"], rel=1e-3
    )
    assert any("not trimmed for the weight of their lines" in line for line in found.findings)
    ball = {"name": "B", "bodies": ["space", "body"], "position": [6.0, 1.0, 0.5], "kind": "ball"}
    with pytest.raises(ValueError, match=r"moor of one body does not support \[\[hinges\]\]; use hakobune simulate"):
        hakobune.moor(study | {"hinges": [ball]}, barge)
