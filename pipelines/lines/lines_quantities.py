"""Quantities of a system of lines (at rest, at offsets and after the loss of a line) and of one line from slack to
taut."""

import numpy as np

from ..results.quantity import Quantity, quantities
from ..results.result import labels, records

REST, BODIES, POINTS = "lines at rest", "bodies at rest", "free points at rest"
MOTION = dict(zip(("x", "y", "z", "roll", "pitch", "yaw"), 3 * ["m"] + 3 * ["rad"], strict=True))
FORCES = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
SHOWN = 1e-9  # stiffness that counts as rounding, over the largest term
OFFSETS = ("offset", "direction")
LEAST_ARM = 1e-3  # m, arm that converts a stiffness of shifts to one of rotations if all rotations are rounding
LINE = {  # name: (unit, description, table, of LineForces)
    "tension.a": ("N", "tension a", REST, lambda at: at.tension_a),
    "tension.b": ("N", "tension b", REST, lambda at: at.tension_b),
    "horizontal.b": ("N", "horizontal b", REST, lambda at: at.horizontal_b),
    "grounded": ("m", "on the bed", REST, lambda at: at.grounded_length),
    "used": ("", "used", REST, lambda at: at.utilisation),
    "horizontal.a": ("N", "horizontal a", "", lambda at: at.horizontal_a),
    "vertical.a": ("N", "downward a", "", lambda at: at.vertical_a),
    "vertical.b": ("N", "downward b", "", lambda at: at.vertical_b),
}


def axes_of(state, curves, losses):
    """{axis: its labels} of all possible results of a SystemEquilibrium"""
    system = state.system
    made = labels("line", system.line_names) | labels("lost", list(losses) or [""])
    made |= labels("body", [body.name for body in system.bodies] or [""])
    made |= labels("point", [point.name for point in system.free_points] or [""])
    made |= labels("force", FORCES) | labels("xyz", ["x", "y", "z"]) | labels("turn", ["roll", "pitch", "yaw"])
    if curves:
        made |= labels("offset", curves[0].offset, "m") | labels("direction", [c.direction for c in curves], "rad")
    return made


def at_rest(state):
    """Lines, bodies and free points at rest"""
    found = {
        name: Quantity(np.asarray(of(state.lines)), ("line",), unit, words, table, name == "used")
        for name, (unit, words, table, of) in LINE.items()
    }
    found["breaking_load"] = Quantity(state.system.breaking_load, ("line",), "N", "breaking load")
    for i, (name, unit) in enumerate(MOTION.items()):
        if state.system.bodies:
            found[f"body.{name}"] = Quantity(state.position[:, i], ("body",), unit, name, BODIES)
    if state.system.free_points:
        for i, name in enumerate("xyz"):
            found[f"point.{name}"] = Quantity(state.pose.free[:, i], ("point",), "m", name, POINTS)
        pressed = np.where(state.on_bed, state.bed_reaction, 0.0)
        table = POINTS if np.any(state.on_bed) else ""
        found["point.pressed"] = Quantity(pressed, ("point",), "N", "pressed on the bed", table)
    found["residual"] = Quantity(np.abs(state.residual).max(initial=0.0), (), "N", "left unbalanced")
    found["steps"] = Quantity(state.iterations, (), "", "steps to the equilibrium")
    return found


def stiffness_on(state, name):
    """Forces on a body for each metre and radian of its motion; rounding errors in all other forces are set to 0"""
    from hakobune.mooring.studies.system_at_rest import mooring_stiffness

    K = mooring_stiffness(state, name)
    shift, turn = np.sqrt(np.abs(np.diag(K)).reshape(2, 3).max(axis=1))
    unit = np.repeat([shift, max(turn, LEAST_ARM * shift)], 3)
    K = np.where(np.abs(K) > SHOWN * np.outer(unit, unit), K, 0.0)
    parts = {
        "shift": (K[:, :3], "xyz", ("N/m", "N m/m"), "for a shift along"),
        "turn": (K[:, 3:], "turn", ("N/rad", "N m/rad"), "for a turn in"),
    }
    return {
        f"stiffness.{part}": Quantity(
            values, ("force", axis), tuple(np.repeat(units, 3).tolist()), words,
            f"stiffness of the lines on {name}, {part}s",
        )
        for part, (values, axis, units, words) in parts.items()
    }  # fmt: skip


def curves_at(curves):
    """Restoring force and tensions at offsets along each direction; nan without an equilibrium"""
    if not curves:
        return {}
    title = f"{curves[0].body} held at offsets from rest"

    def stacked(of):
        return np.stack([of(curve) for curve in curves], axis=1)

    made = quantities(title, {
        "curve.restoring": (stacked(lambda c: c.restoring), "N", "restoring"),
        "curve.tension": (stacked(lambda c: c.tension.max(axis=1)), "N", "largest tension"),
    }, "offset", "direction")  # fmt: skip
    return made | records({
        "curve.line_tension": (stacked(lambda c: c.tension), (*OFFSETS, "line"), "N", "tension"),
        "curve.line_grounded": (stacked(lambda c: c.grounded_length), (*OFFSETS, "line"), "m", "on the bed"),
    })  # fmt: skip


def lost(state, losses, name):
    """The system after the loss of each line; name : name of the body with the reported shift; nan without an
    equilibrium"""
    from hakobune.mooring.studies.system_at_rest import body_number

    i = None if name is None else body_number(state.system, name)
    names = list(state.system.line_names)
    tension = np.full((len(losses), len(names)), np.nan)
    used, shift = np.full((2, len(losses)), np.nan)
    for row, left in enumerate(losses.values()):
        if isinstance(left, Exception):
            continue
        tension[row, [names.index(kept) for kept in left.system.line_names]] = left.tension
        used[row] = np.fmax.reduce(left.lines.utilisation)
        shift[row] = np.nan if i is None else np.linalg.norm(left.position[i, :3] - state.position[i, :3])
    largest = np.fmax.reduce(tension, axis=1)
    worst = [names[int(np.nanargmax(row))] if np.isfinite(row).any() else "" for row in tension]
    made = quantities("one line broken", {
        "loss.tension": (largest, "N", "largest tension"),
        "loss.worst": (worst, "", "in"),
        "loss.used": (used, "%", "used"),
    }, "lost")  # fmt: skip
    made |= quantities(
        "one line broken" if name else "", {"loss.shift": (shift, "m", f"{name or 'body'} moves")}, "lost"
    )
    return made | quantities("", {"loss.line_tension": (tension, "N", "tension")}, "lost", "line")


def line_alone(state, name):
    """A line of the system from slack to taut, and the labels of its spans"""
    from hakobune.mooring.lines.system.characteristic import characteristic

    found = characteristic(state, name)
    made = quantities(f"{name}, from slack to taut", {
        "characteristic.horizontal": (found.horizontal, "N", "horizontal"),
        "characteristic.tension": (found.tension, "N", "tension"),
        "characteristic.grounded": (found.grounded, "m", "on the bed"),
        "characteristic.used": (found.utilisation, "%", "used"),
    }, "at_span")  # fmt: skip
    made["characteristic.span"] = Quantity(found.rest, (), "m", f"span of {name} as it hangs")
    return made, labels("at_span", found.span, "m", "span")


def periods_of(state, name, db):
    """Natural periods of a body on its lines, nan for an unstable one, and the labels of its modes"""
    from hakobune.mooring.studies.natural_periods import moored_periods

    found = moored_periods(state, name, db)
    modes = [mode.lower() for mode in found.names]
    return {"period": Quantity(found.period, ("mode",), "s", "natural period", f"natural periods of {name}")}, labels(
        "mode", modes
    )
