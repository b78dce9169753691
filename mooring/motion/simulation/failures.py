"""Reason of a run's stop, in one line: time, place, fault, and remedy."""

import numpy as np

from .. import integrator
from ..contact_loads import DEPTH
from ..equation import blocks, buoy_at
from ..line_loads import REACH


class SimulationError(ValueError):
    """A run that cannot start or continue: the message names the time, the number and a remedy."""


class Overload(SimulationError):
    """A run in which a fender is compressed beyond its table, or a line pulls more than its breaking load."""


def stopped(state, clock, settings, scene, moored, hung, stuck):
    """The error of a run that stops, an `Overload` or another `SimulationError`"""
    broken = state == integrator.BEYOND or _parting(state, scene, moored) is not None
    return (Overload if broken else SimulationError)(failure(state, clock, settings, scene, moored, hung, stuck))


def failure(state, clock, settings, scene, moored, hung, stuck):
    t, names = clock.now[integrator.TIME], [one.name for one in getattr(moored.reader, "bodies", ()) if not one.fixed]
    places = blocks(clock.y, len(clock.scale))
    away = [
        f"{name} {np.hypot(*place[:2]):.3g} m from its place"
        for name, place in zip(names or ["the body"], places, strict=True)
    ]
    where = f"at {t - settings.ramp:.4g} s after the ramp, {', '.join(away)}"
    if state == integrator.BEYOND:
        i = int(scene.contact_work.beyond[0])
        depth, limit = scene.contact_work.now[i, DEPTH], scene.contacts.table.marks[i, 1]
        return (
            f"{where}: fender {moored.berth.names[i]} is compressed by {depth:.3g} m, beyond its table, which ends at "
            f"{limit:.3g} m; choose a larger fender, or give it an overload stiffness"
        )
    if state == integrator.STUCK:
        return (
            f"{where}: line {moored.system.line_names[stuck]}: the motion of this line cannot be integrated; leave it "
            "out of dynamic_lines, or raise the tolerance"
        )
    if moored.buoy is not None and state in (integrator.NO_LINE, integrator.TOO_SHORT):
        return f"{where}: {_of_buoy(state, clock, hung[1])}"
    name, tension = _tightest(scene.line_work, moored)
    if (load := _parting(state, scene, moored)) is not None:
        return (
            f"{where}: line {name} pulls {tension:.3g} N, {tension / load:.2g} times its breaking load, and "
            "would part: use a stronger line, or reduce the loads"
        )
    if state == integrator.NO_LINE:
        return (
            f"{where}: a line cannot reach its fairlead, its end is below the bed, or a line of segments is "
            f"beyond the table of its forces, {REACH[1]:g} of the depth up or down; give a longer line, or reduce the "
            f"loads"
        )
    if state == integrator.TOO_SHORT:
        rigid = name and not scene.lines.lines[_number(moored, name), 2] > 0
        way = "give it an axial stiffness" if rigid else "raise the tolerance or use a softer line"
        pulled = f"line {name} pulls {tension:.3g} N; {way}" if name else "check inertia, damping and stiffness"
        return f"{where}: steps below {integrator.SHORTEST:g} s are required; {pulled}"
    return f"{where}: the motion is not finite; check inertia, damping and stiffness"


def _parting(state, scene, moored):
    """Breaking load N of the line with the largest pull, if that pull is above it and lines have no solution"""
    if state != integrator.NO_LINE or moored.buoy is not None:
        return None
    name, tension = _tightest(scene.line_work, moored)
    load = moored.system.breaking_load[_number(moored, name)]
    return load if tension > load else None


def _of_buoy(state, clock, work):
    """Why a body with a buoy cannot be followed"""
    first = buoy_at(len(clock.scale))
    away, pull = np.hypot(*clock.y[first : first + 2]), work.rope.max()
    if state == integrator.NO_LINE:
        return (
            f"the buoy is {away:.3g} m from its place without the body, where a line cannot reach it; lengthen "
            "the lines or give them an axial stiffness"
        )
    return (
        f"steps below {integrator.SHORTEST:g} s are required, and a hawser pulls {pull:.3g} N; use a softer "
        "hawser or a heavier buoy"
    )


def _number(moored, name):
    return moored.system.line_names.index(name)


def _tightest(kept, moored):
    """Name and pull of the line with the largest pull; None without lines"""
    if not len(kept.whole):
        return None, 0.0
    pull = np.nan_to_num(np.hypot(*kept.tension.T))
    return moored.system.line_names[int(pull.argmax())], float(pull.max())
