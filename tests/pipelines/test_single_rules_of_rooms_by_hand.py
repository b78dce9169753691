"""Single rules of several commands, each by hand: addresses of files, waves of a line, rounding of a stiffness, panels
along a wave, damping that a record leaves out, a buoy that is pulled under."""

import math
import tomllib
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.modes import Body
from hakobune.mooring.studies import system_at_rest
from hakobune.pipelines.breakwater.study import _check_water
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.resonances import resonance_lines
from hakobune.pipelines.design import report
from hakobune.pipelines.downtime.result import _viscous
from hakobune.pipelines.line_dynamics.parts import wave_of
from hakobune.pipelines.lines.lines_quantities import stiffness_on
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.scene.tables import SceneError
from hakobune.pipelines.single_point.study import check_buoy
from hakobune.pipelines.solve import hull, problem
from hakobune.pipelines.solve.bending import modes


def test_the_file_of_a_number_has_its_address_from_the_folder_of_the_report(monkeypatch):
    case, factored = SimpleNamespace(name="storm"), SimpleNamespace(name="storm × 1.5")
    verdict = SimpleNamespace(ran=[SimpleNamespace(case=case), SimpleNamespace(case=factored)])
    monkeypatch.setattr(report.words, "with_factor", lambda name, factor: f"{name} × {factor:g}" if factor else name)
    monkeypatch.setattr(report, "origin", lambda read, one, criterion: (criterion.file, one.case.name))
    found = report._found_in("read", verdict, "/p/out/page")
    for file, factor, told in (
        ("/p/out/page/runs/a.h5", 0, ("runs/a.h5", "storm")),
        ("/p/bases/b.h5", 1.5, ("../../bases/b.h5", "storm × 1.5")),
        ("/p/out/c.h5", 2.0, ("../c.h5", "storm")),
        (None, 0, ("", "storm")),
    ):
        assert found("storm", SimpleNamespace(file=file, motion_factor=factor)) == told


def wave(**more):
    given = {"height": 3.0, "period": 8.0, "direction_deg": 30.0, "incidence_deg": None, "phase_deg": 60.0}
    water = SimpleNamespace(depth=50.0, gravity=9.80665)
    return SimpleNamespace(sea=None, wave=SimpleNamespace(**given | more), water=water)


def test_a_wave_on_a_line_has_half_its_height_and_its_way_and_phase():
    train = wave_of(wave(), 20.0)
    assert (train.amplitude, train.period, train.depth, train.ramp) == (1.5, 8.0, 50.0, 20.0)
    assert train.direction == pytest.approx(math.pi / 6) and train.phase == pytest.approx(math.pi / 3)
    assert wave_of(SimpleNamespace(sea=None, wave=None, water=wave().water), 20.0) is None
    with pytest.raises(StudyError, match=r"wave.height is 15 m; allowed: up to .* at which such a wave breaks"):
        wave_of(wave(height=15.0), 20.0)  # 0.142 · 99.9 m in deep water, of 8 s


@pytest.mark.parametrize("turning, arm", [(9e8, 3e4), (0.0, 2.0)])
@pytest.mark.parametrize("times, kept", [(1.01, True), (0.99, False)])
def test_a_stiffness_below_1e9th_of_the_largest_is_rounding(turning, arm, times, kept, monkeypatch):
    """√4e6 = 2000 of shifts; of turns √9e8, or 1 mm of arm without any"""
    K = np.diag([1e6, 4e6, 1e6, turning, 0.0, 0.0])
    small = {(0, 1): 4e-3, (2, 4): 2e-6 * arm, (5, 0): -2e-6 * arm, (4, 5): 1e-9 * arm**2}
    for place, value in small.items():
        K[place] = times * value
    monkeypatch.setattr(system_at_rest, "mooring_stiffness", lambda state, name: K)
    found = stiffness_on("state", "barge")
    shown = np.hstack([found["stiffness.shift"].values, found["stiffness.turn"].values])
    assert np.diag(shown).tolist() == np.diag(K).tolist()
    assert [bool(shown[place]) for place in small] == 4 * [kept]
    if kept:
        assert shown.tolist() == K.tolist()


def test_a_body_of_several_is_the_one_of_its_number(monkeypatch):
    monkeypatch.setattr(modes, "bodies_of", lambda scene: ["ship", "barge", "pier"])
    several = SimpleNamespace(several=True)
    assert [modes._body(several, i) for i in range(3)] == ["ship", "barge", "pier"]
    assert modes._body(SimpleNamespace(several=False), 0) is None


LID = """
[water]
depth = 20.0
[[bodies]]
shape = "box"
length = 100.0
beam = 50.0
draft = 10.0
[[damping_lids]]
damping = 10.0
corners = [[0, 30], [10, 30], [10, 40]]
[waves]
omegas = [0.5]
headings_deg = [0]
"""


@pytest.mark.parametrize("old, bad, says", [
    ("damping = 10.0", "damping = 10.1", "damping_lids[0].damping is 10.1; allowed: 1e-06 to 10"),
    ("[10, 40]", "[10, 2e6]", "damping_lids[0].corners is [10.0, 2000000.0, 0.0]; allowed: three numbers"),
    ("[10, 40]", "[20, 30]", "damping_lids[0].corners "),
    ("[water]", "wall = 60.0\n[water]", "damping_lids and a wall are given; give only one of them"),
])  # fmt: skip
def test_a_damping_lid_of_a_scene_is_checked(old, bad, says):
    make_scene(tomllib.loads(LID))
    with pytest.raises(SceneError) as refused:
        make_scene(tomllib.loads(LID.replace(old, bad)))
    assert says in str(refused.value)


@pytest.mark.parametrize("edge, total, says", [
    (20.0, 300, None), (0.59, 20_000, None), (0.58, 300, "require 20214 panels; allowed: 20000"),
    (20.0, 20_001, "require 20001 panels; allowed: 20000"),
])  # fmt: skip
def test_a_mesh_has_its_panels_along_the_shortest_wave_or_is_refused(edge, total, says, monkeypatch):
    """4.7 panels along a wave; 100 · 40 + 2 · 140 · 10 = 6800 m² are at least 6800/edge² panels"""
    asked = []

    def meshed(*given):
        asked.append(given)
        return SimpleNamespace(total=total)

    monkeypatch.setattr(hull, "stands_on_bed", lambda scene, body: False)
    monkeypatch.setattr(hull, "fine_counts", lambda body, tolerance, edge, bottom: (tolerance, edge, bottom))
    monkeypatch.setattr(hull, "meshed", meshed)
    body = SimpleNamespace(shape="box", length=100.0, beam=40.0, draft=10.0)
    scene = SimpleNamespace(shortest_wave=4.7 * edge, accuracy=0.02)
    if says is None:
        assert hull._fine_enough(scene, body).total == total
    else:
        with pytest.raises(SceneError) as refused:
            hull._fine_enough(scene, body)
        assert says in str(refused.value) and f"tolerance 0.02 and the shortest wave, {4.7 * edge:.3g} m" in str(
            refused.value
        )
    assert asked == ([] if edge == 0.58 else [(body, (0.02, pytest.approx(edge), True), True)])


@pytest.mark.parametrize("ratio, told", [
    (0.05, "body.damping_ratio takes its place"),
    (None, "motions near resonance are too large; give body.damping_ratio"),
])  # fmt: skip
def test_what_stands_for_the_viscous_damping_of_a_database_is_told(ratio, told):
    def said(viscous, has):
        read = SimpleNamespace(body=SimpleNamespace(viscous=viscous, damping_ratio=ratio))
        return list(_viscous(read, SimpleNamespace(has_viscous_motions=has)))

    assert said(None, True) == [
        f"the viscous damping of the database's scene is not included, since it differs from hour to hour: {told}"
    ]
    assert said(None, False) == []
    with pytest.raises(StudyError, match=r"body.viscous is linearised in one sea; give damping_ratio"):
        said("table", False)


@pytest.mark.parametrize("sunk, good", [(0.499, True), (0.501, False)])
def test_a_buoy_that_its_lines_pull_under_is_told_with_their_pull_in_kilonewtons(sunk, good):
    made = SimpleNamespace(
        point=SimpleNamespace(system=SimpleNamespace(bodies=[SimpleNamespace(position=(0.0, 0.0, 1.0))])),
        draft_left=0.5,
    )
    lines = SimpleNamespace(position=np.array([[0, 0, 1 - sunk]]), lines=SimpleNamespace(vertical_b=np.full(4, 31e3)))
    if good:
        check_buoy(made, SimpleNamespace(lines=lines))
        return
    with pytest.raises(StudyError, match=r"down with 124 kN, so it sinks by 0.501 m; allowed: its freeboard of 0.5 m"):
        check_buoy(made, SimpleNamespace(lines=lines))


@pytest.mark.parametrize("row, share", [(1, None), (0, 0), (2, 0)])
def test_the_stored_frequency_nearest_to_a_resonance_counts_however_far(row, share):
    """Stored at 0.3, 0.6 and 3 rad/s, a resonance at 1 rad/s, whose surroundings are a tenth: 0.6 is nearest"""
    one = SimpleNamespace(omega=1.0, damping=0.01, mode=2, peak=2.0, name="heave", period=2 * math.pi, heading=0.0,
                          viscous=True, error=0.0)  # fmt: skip
    omega = np.array([0.3, 0.6, 3.0])
    rao = np.zeros((3, 2, 6), complex)
    rao[row, 1, 2] = -2j
    (said,) = resonance_lines([one], omega, rao)
    assert said.endswith("damping ratio 0.01" if share is None else "stored frequencies near it show 0 % of the peak")


@pytest.mark.parametrize("change, says", [
    ({"gravity": 0.0}, "water.gravity"), ({"density": -1.0}, "water.density"), ({"depth": 0.0}, "water.depth"),
    ({"tide": 20.0}, "water.tide is 20 m; allowed: 0 to below the depth of 20 m"), ({"tide": -0.1}, "water.tide is"),
])  # fmt: skip
def test_the_water_of_a_breakwater_is_checked_number_by_number(change, says):
    good = {"depth": 20.0, "density": 1025.0, "gravity": 9.80665, "tide": 19.9}
    _check_water(SimpleNamespace(**good))
    with pytest.raises(StudyError, match=says):
        _check_water(SimpleNamespace(**good | change))


@dataclass(frozen=True)
class Viscous:
    names: tuple
    drag: float = 0.7


@pytest.mark.parametrize("viscous", [None, Viscous(("Roll",))])
def test_shapes_add_to_the_problem_their_stiffness_damping_and_the_names_of_what_moves(viscous, monkeypatch):
    """A ship beside a pier that stands still, with one shape of the ship and one of both"""
    own, both = SimpleNamespace(name="bending", body=0, on=()), SimpleNamespace(name="hinge", body=0, on=(0, 1))
    monkeypatch.setattr(problem, "own_hulls_of_modes", lambda scene, mesh: (scene, mesh))
    monkeypatch.setattr(problem, "modes_of", lambda scene, hulls: [own, both] if hulls == ("scene", "mesh") else None)
    waters, steel = np.diag(np.arange(14.0)), np.diag(np.r_[np.zeros(12), 5e6, 7e6])
    kept = {"hydrostatic_stiffness": waters, "structural_stiffness": steel, "structural_damping": "damping"}
    bodies = [Body("ship"), Body("pier", fixed=True)]
    made = problem._with_modes(
        SimpleNamespace(mesh="mesh", body=kept), "scene", {"bodies": bodies, "viscous": viscous, "depth": 20.0}
    )
    assert made["modes"] == [own, both] and made["structural_damping"] == "damping"
    assert np.diag(made["hydrostatic_stiffness"]).tolist() == [*range(12), 12 + 5e6, 13 + 7e6]
    moving = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw", "bending")
    names = (*(f"ship__{name}" for name in moving), "hinge")
    assert made["viscous"] == (None if viscous is None else Viscous(names))
    assert len(made) == 4
