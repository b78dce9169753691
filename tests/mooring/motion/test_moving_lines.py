"""Lines with a motion of their own on a body in time: as a line driven alone, and slowly as its static shape."""

import re
from dataclasses import replace

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.formats.moordyn_writing import moordyn_of_system
from hakobune.mooring.lines.catalogue import line_type
from hakobune.mooring.lines.dynamics.simulation import FairleadMotion
from hakobune.mooring.lines.dynamics.simulation import simulate as drive
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import Anchor, Fairlead, LineDynamics, UniformLine
from hakobune.mooring.motion.equation import SAMPLED
from hakobune.mooring.motion.line_loads import body_lines, fairlead_course, line_work, loads_at
from hakobune.mooring.motion.moving_lines.at_rest import moving_work, state_pull
from hakobune.mooring.motion.moving_lines.polynomial import TERMS
from hakobune.mooring.motion.moving_lines.prepare import dynamic_line, moving_of
from hakobune.mooring.motion.moving_lines.steps import advance_lines, compile_moving, keep_lines
from hakobune.mooring.motion.simulation import able_to_move, simulate, with_lines_chosen
from hakobune.mooring.motion.weather import Settings, Weather

ROUGH = Weather((Sea(jonswap(2.0, peak_period=9.0), np.pi),))
WANTED = Settings(40.0, ramp=40.0, step=0.1, dynamic_lines=("fore port 1", "aft port 1"))


def bent(body):
    """With EI of 1e8 N m² in the first of its lines, which bends over 16 m at its ends"""
    lines = body.system.lines
    stiff = replace(lines[0].type, dynamics=LineDynamics(bending_stiffness=1e8))
    return replace(body, system=replace(body.system, lines=(replace(lines[0], type=stiff), *lines[1:])))


def test_a_line_pulls_as_the_same_line_driven_alone(on_lines):
    number = on_lines.system.line_names.index("fore port 1")
    run = simulate(on_lines, ROUGH, WANTED, seed=1)
    place, velocity = fairlead_course(body_lines(on_lines.system), number, np.hstack([run.motion, run.velocity]))
    line, t = line_of(on_lines, number), run.time - run.time[0]
    alone = drive(line, FairleadMotion.table(t, place, velocity), t[-1], tolerance=1e-5, check_mesh=False)
    pull = np.interp(t, alone.time, alone.tension_fairlead)
    off = np.sqrt(np.mean((run.tension[:, number] - pull) ** 2))
    assert off <= 1e-3 * pull.max() and pull.std() > 1e-2 * pull.max()
    assert np.ptp(place, axis=0).max() > 0.1  # it moves


def test_kernels_of_lines_compiled_ahead_are_the_versions_that_a_run_calls(on_lines):
    simulate(on_lines, ROUGH, replace(WANTED, ramp=1.0, duration=1.0), seed=1)
    called = [set(one.called.overloads) for one in (advance_lines, keep_lines)]
    number = on_lines.system.line_names.index("fore port 1")
    line = line_of(on_lines, number)
    compile_moving(line, np.add(line.anchor, [250.0, 0.0, 20.0]))
    assert all(called) and [set(one.called.overloads) for one in (advance_lines, keep_lines)] == called


def test_a_line_that_bends_beside_one_that_does_not_pulls_along_a_course_as_driven_alone(on_lines):
    """Steps of the body of 0.1 s, without a body: a run with lines that bend takes half a minute to compile"""
    body, h = bent(on_lines), 0.1
    moving, states = moving_of(body, WANTED)
    work, whole = (
        moving_work(moving, states, 1, len(body.system.lines), (1, SAMPLED)),
        np.ones(len(body.system.lines), bool),
    )
    t, rest = h * np.arange(201), [state.position[-1] for state in states]
    halves = 0.5 * h * np.arange(401)
    sway, speed = 0.6 * np.sin(0.9 * halves) ** 2, 0.54 * np.sin(1.8 * halves)
    pulls = np.full((201, 2), [np.linalg.norm(state_pull(moving, i, one)) for i, one in enumerate(states)])
    for k in range(200):
        for i in range(2):
            for part in range(3):
                work.course[i, part] = rest[i] + [sway[2 * k + part], 0, 0], [speed[2 * k + part], 0, 0]
        assert advance_lines(moving, work, whole, t[k], h)
        keep_lines(moving, work, h, np.zeros((len(whole), TERMS, 3)))
        for i in range(2):
            pulls[k + 1, i] = np.linalg.norm(work.pull[i, work.used[i] - 1])
    for i, number in enumerate(moving.number):
        line, moved = line_of(body, number), np.outer(sway[::2], [1.0, 0, 0])
        motion = FairleadMotion.table(t, rest[i] + moved, np.outer(speed[::2], [1.0, 0, 0]))
        alone = drive(line, motion, t[-1], tolerance=1e-5, check_mesh=False)
        pull = np.interp(t, alone.time, alone.tension_fairlead)
        assert line.bends == (i == 0)
        assert np.sqrt(np.mean((pulls[:, i] - pull) ** 2)) <= 1e-3 * pull.max() and pull.std() > 1e-2 * pull.max()


def line_of(body, number):
    """The DynamicLine of a line of a body in WANTED"""
    anchor = body_lines(body.system).anchor[number]
    return dynamic_line(body.system.lines[number], anchor, body.system, WANTED.dynamic_elements)


def test_lines_that_are_not_asked_for_hang_in_their_static_shape(on_lines):
    some = simulate(on_lines, ROUGH, WANTED, seed=1)
    none = simulate(on_lines, ROUGH, replace(WANTED, dynamic_lines=()), seed=1)
    assert not np.array_equal(some.tension[:, 0], none.tension[:, 0])
    again = simulate(on_lines, ROUGH, WANTED, seed=1)
    assert np.array_equal(again.tension, some.tension) and np.array_equal(again.motion, some.motion)


def test_slow_lines_pull_as_in_their_static_shape_and_few_elements_are_named(on_lines):
    """At rest in 80 elements; the difference of 10 is told"""
    lines = body_lines(on_lines.system)
    static = line_work(lines)
    loads_at(lines, static, on_lines.start.reshape(1, 6), np.zeros((1, 3, 3)), np.zeros((1, 6)))
    moving, states = moving_of(on_lines, replace(WANTED, dynamic_lines="all", dynamic_elements=80))
    pulls = [np.linalg.norm(state_pull(moving, i, state)) for i, state in enumerate(states)]
    assert np.allclose(pulls, np.hypot(*static.tension.T), rtol=1e-3)
    told = simulate(on_lines, ROUGH, replace(WANTED, duration=10.0, ramp=5.0, dynamic_elements=10)).findings
    assert any("in 10 elements pulls" in line for line in told) and any("still water" in line for line in told)


def test_lines_of_a_high_deck_weigh_as_in_air_above_the_water_and_are_not_called_coarse_for_it(on_lines):
    up = tuple(
        replace(point, position=(*point.position[:2], point.position[2] + 15.0))
        if isinstance(point, Fairlead)
        else point
        for point in on_lines.system.points
    )
    high = replace(on_lines, system=replace(on_lines.system, points=up))
    fine = replace(WANTED, dynamic_lines="all", dynamic_elements=80)
    pulls = [np.linalg.norm(state_pull(*one)) for one in (_first(high, fine, True), _first(high, fine, False))]
    assert pulls[0] > 1.002 * pulls[1]
    told = simulate(high, ROUGH, replace(fine, duration=2.0, ramp=2.0)).findings
    assert not any("elements pulls" in line for line in told)


def _first(body, settings, surface):
    """Arguments of `state_pull` of the first line"""
    moving, states = moving_of(body, settings, surface=surface)
    return moving, 0, states[0]


def test_a_trial_lets_all_lines_move_where_that_changes_what_is_found(on_lines):
    """In waves from ahead all do, in ripples none, without waves there is no trial; a run is that with these names"""
    asked = replace(WANTED, dynamic_lines="auto")
    chosen = with_lines_chosen(on_lines, ROUGH, asked)
    assert chosen.settings.dynamic_lines == tuple(on_lines.system.line_names) and "4 of 4 lines have" in chosen.words[0]
    run, named = (simulate(on_lines, ROUGH, one, seed=2) for one in (asked, chosen.settings))
    assert np.array_equal(run.motion, named.motion) and chosen.words[0] in run.findings
    ripples = Weather((Sea(jonswap(0.1, peak_period=9.0), np.pi),))
    still = with_lines_chosen(on_lines, ripples, asked)
    assert still.settings.dynamic_lines == () and "stay in their static shape" in still.words[0]
    assert with_lines_chosen(on_lines, Weather(), asked).words == ()


def test_lines_that_cannot_move_are_named_as_left_out_with_the_key_that_helps(on_lines):
    plain = tuple(replace(line, type=replace(line.type, mass=None)) for line in on_lines.system.lines)
    bare = replace(on_lines, system=replace(on_lines.system, lines=plain))
    chosen = with_lines_chosen(bare, ROUGH, replace(WANTED, dynamic_lines="auto"))
    told = chosen.left_out[0]
    assert chosen.settings.dynamic_lines == () and told.startswith("left out: inertia and drag of line")
    assert "has no mass; give a type with a catalogue name" in told and "snap loads 1.6 to 9 times on chains" in told
    mixed = replace(on_lines, system=replace(on_lines.system, lines=(plain[0], *on_lines.system.lines[1:])))
    assert able_to_move(mixed.system, WANTED)[0] == tuple(on_lines.system.line_names[1:])


def test_a_trial_sees_what_waves_from_abeam_keep_up_along_a_symmetric_body_on_static_chains(on_lines):
    """No force acts along the body or turns it; a yaw that moving chains damp is kept up on chains that only stiffen"""
    abeam = Weather((Sea(jonswap(2.5, peak_period=9.0), 0.5 * np.pi),))
    asked = replace(WANTED, duration=300.0, ramp=100.0, step=0.5, dynamic_lines="auto")
    (words,) = with_lines_chosen(on_lines, abeam, asked).words
    static, moving = (
        float(x) for x in re.search("slow yaw has σ (.+) ° with static lines and (.+) ° with", words).groups()
    )
    assert static > 1.2 * moving > 0 and "4 of 4 lines have" in words
    unprompted = simulate(on_lines, abeam, replace(asked, dynamic_lines=()))
    assert np.abs(unprompted.motion[:, 5]).max() < 1e-3 * np.radians(static)


def test_names_and_types_that_cannot_move_are_refused(on_lines):
    for names, told in ((("nix",), "no line named 'nix'"), ("every", 'allowed: "all"')):
        with pytest.raises(ValueError, match=told):
            simulate(on_lines, ROUGH, replace(WANTED, dynamic_lines=names))
    plain = tuple(replace(line, type=replace(line.type, mass=None)) for line in on_lines.system.lines)
    bare = replace(on_lines, system=replace(on_lines.system, lines=plain))
    with pytest.raises(ValueError, match="has no mass"):
        simulate(bare, ROUGH, replace(WANTED, dynamic_lines="all"))


@pytest.mark.parametrize("known", [True, False])
def test_a_line_moves_with_the_water_that_a_moordyn_file_of_it_says(known):
    kind = line_type("R3 studless 84 mm")
    kind = kind if known else replace(kind, dynamics=None)
    line = UniformLine("port", kind, 300.0, "anchor", "fairlead")
    ends = (Anchor("anchor", (-280.0, 0.0, -60.0)), Anchor("fairlead", (0.0, 0.0, 0.0)))
    system = System(60.0, (line,), ends)
    row, one = moordyn_of_system(system).line_types[0], dynamic_line(line, ends[0].position, system, 20).segments[0]
    assert (row.Cd, row.CdAx) == (one.drag_normal, one.drag_tangential)
    assert (row.Ca, row.CaAx) == (one.added_normal, one.added_tangential)
    assert float(row.BA) == -one.damping_ratio
