"""Quantities of a single-point study: (quantities, labels of their axes) of each of its parts."""

import numpy as np

from hakobune.mooring.lines.system.parts import UniformLine
from hakobune.mooring.single_point.criterion import routh_hurwitz, undamped, undamped_stable
from hakobune.mooring.single_point.equilibria import bow
from hakobune.mooring.single_point.history import watch_circle, wave_deviations
from hakobune.mooring.single_point.in_time import ropes_of
from hakobune.mooring.single_point.scope import length_without_uplift
from hakobune.mooring.single_point.yaw_criteria import yaw_stability

from ..common.quantities import force
from ..results.quantity import Quantity, quantities
from ..results.result import labels, records
from . import running
from .findings import drafts_of, periods_of_buoy, pulled_down, used

# range of line lengths, over the given one, and number of steps of the search for changes of stability
REACH, LENGTHS = (0.02, 20.0), 200
ROUNDING = 1e-7  # rad, of a heading of rest
STABLE = {True: "stable", False: "slews"}


def turned(heading):
    """rad, 0 up to 2π, of headings of rest"""
    return np.where(np.abs(heading) < ROUNDING, 0.0, np.remainder(heading, 2 * np.pi))


def hawsers_of(point):
    return [f"hawser {i}" for i in range(1, len(point.lengths) + 1)]


def rest_of(found):
    """All headings of rest"""
    rest, title = found.rest, "headings of rest"
    slewing = [one.slewing for one in rest]
    rows = {
        "rest.heading": (turned([one.heading for one in rest]), "rad", "heading", title),
        "rest.stable": ([s.stable for s in slewing], "", "stable", title),
        "rest.growth": ([s.growth for s in slewing], "1/s", "growth", title),
        "rest.period": ([s.period for s in slewing], "s", "period", title),
        "rest.pull": ([one.pull for one in rest], "N", "pull", title),
        "rest.largest_line": ([one.lines.tension.max() for one in rest], "N", "largest line", title),
        "rest.place": ([one.place for one in rest], "m", "centre of mass", ""),
        "rest.buoy": ([one.lines.position[0, :2] for one in rest], "m", "buoy", ""),
        "rest.buoy_z": ([one.lines.position[0, 2] for one in rest], "m", "buoy, z", ""),
        "rest.force": ([one.force for one in rest], "N, N, N m", "force of wind, water and drift", ""),
        "rest.hawser": ([one.hawser for one in rest], "N", "pull of", title if len(rest[0].hawser) > 1 else ""),
        "rest.line": ([one.lines.tension for one in rest], "N", "tension", ""),
        "rest.root": ([one.roots for one in rest], "1/s", "eigenvalue of small motions", ""),
        "rest.quartic": ([[np.nan] * 5 if q.quartic is None else q.quartic for q in rest], "", "quartic", ""),
    }
    second = {"place": "xy", "buoy": "xy", "force": "plane", "hawser": "hawser", "line": "line", "root": "root"}
    second["quartic"] = "power"
    made = {}
    for name, (values, unit, words, table) in rows.items():
        more = second.get(name.removeprefix("rest."))
        made[name] = Quantity(np.asarray(values), ("rest", *((more,) if more else ())), unit, words, table)
    axes = labels("rest", np.arange(1, len(rest) + 1)) | labels("xy", ["x", "y"])
    axes |= labels("plane", ["ahead", "to port", "turning"]) | labels("hawser", hawsers_of(found.point))
    axes |= labels("line", found.point.system.line_names) | labels("root", np.arange(1, len(rest[0].roots) + 1))
    return made, axes | labels("power", ["λ⁴", "λ³", "λ²", "λ", "1"])


def state_of(found):
    """The final heading, the slewing about it, and published criteria of slewing"""
    one = found.best
    (x, y), s, title = one.place, one.slewing, f"at {bow(one):.4g}°, the heading at which it comes to rest"
    state = {
        "heading": (float(turned(one.heading)), "rad", "heading, from +x to the bow"),
        "place.x": (x, "m", "centre of mass, x"),
        "place.y": (y, "m", "centre of mass, y"),
        "buoy.x": (one.buoy[0], "m", "buoy, x"),
        "buoy.y": (one.buoy[1], "m", "buoy, y"),
        **_draft(found),
        "pull": (one.pull, "N", "steady pull"),
        "slewing": ("stable" if s.stable else "unstable", "", "slewing" if s.stable or one.slews else "surge"),
        "slewing.time": (1 / abs(s.growth), "s", f"{'grows' if s.growth > 0 else 'decays'} by a factor of e in"),
        "slewing.period": (s.period, "s", "period"),
    }
    load = None if found.study.hawser is None else force("hawser", found.study.hawser, "breaking_load")
    if load is not None:
        state["hawser.used"] = (max(one.hawser) / load, "%", "steady pull over the hawser's breaking load")
    growth = {"slewing.growth": (s.growth, "1/s", "growth, below 0 for decay")}
    return quantities(title, state) | quantities("", growth) | _scope(found) | _criteria(one), {}


def natural_of(found):
    """Slow motions about the final heading, and natural periods of its buoy"""
    one, buoy = found.best, found.study.buoy
    names = [mode.words for mode in one.modes]
    rows = [(mode.period, mode.root.real) for mode in one.modes]
    if buoy.diameter is not None:
        names += ["buoy, sideways", "buoy, sideways", "buoy, heave"]
        rows += [(period, np.nan) for period in periods_of_buoy(buoy, found.point.system, one)]
    names = [name if names.count(name) == 1 else f"{name} {names[:i].count(name) + 1}" for i, name in enumerate(names)]
    title = f"natural periods at {bow(one):.4g}°: hull on a hawser that does not stretch, buoy on its lines alone"
    made = quantities(title, {
        "natural.period": ([row[0] for row in rows], "s", "period"),
        "natural.growth": ([row[1] for row in rows], "1/s", "growth"),
    }, "mode")  # fmt: skip
    return made, labels("mode", names)


def _draft(found):
    """Draft of a buoy that floats"""
    buoy = found.study.buoy
    if buoy.diameter is None:
        return {}
    return {"buoy.draft": (drafts_of(buoy, found.point.system, found.best)[1], "m", "draft of the buoy")}


def _scope(found):
    """Length at which the most loaded line has no uplift at its anchor"""
    one, system = found.best, found.point.system
    line, title = system.lines[int(np.argmax(one.lines.tension))], "scope without uplift, under steady loads"
    if not isinstance(line, UniformLine) or not line.type.weight > 0:
        return {}
    height = one.lines.position[0, 2] + system.depth
    need = float(length_without_uplift(one.lines.tension.max(), line.type.weight, height))
    return quantities(title, {
        "scope.depths": (need / system.depth, "", "depths"),
        "scope.length": (need, "m", "length"),
        "scope.line": (float(line.length), "m", "length of the line"),
    })  # fmt: skip


def _criteria(one):
    if one.quartic is None:
        return {}
    m, y = one.lateral, yaw_of(one)
    straight = {"criterion.straight_line": (y.straight_line, "N2 s2", "Y_v N_r − N_v (Y_r − MU)")}
    return quantities("criteria of slewing", {
        "criterion.line": (m.length, "m", "effective line"),
        "criterion.routh_hurwitz": (STABLE[bool(routh_hurwitz(one.quartic))], "", "Routh–Hurwitz"),
        "criterion.undamped": (STABLE[bool(undamped_stable(undamped(one.quartic)))], "", "undamped"),
        "criterion.arm": (m.arm, "m", "attachment ahead of the centre of mass"),
        "criterion.lever": (y.lever, "m", "centre of the side force at a small heading, ahead of the centre of mass"),
        "criterion.static": ("stable" if y.static else "unstable", "", "in yaw, statically"),
        "criterion.straight": (bool(y.straight_line > 0), "", "keeps a straight course when towed"),
    }) | quantities("", straight)  # fmt: skip


def yaw_of(one):
    """YawStability of an Equilibrium that has a quartic (`criterion`)"""
    length = one.lateral.length
    return yaw_stability(one.lateral, float(one.state[3]), np.geomspace(*REACH, LENGTHS) * length)


def lines_at(found):
    """Lines at the final heading, and the largest utilisation of their breaking load"""
    one = found.best
    lines = one.lines.lines
    shares = used(found.study, one, found.cycle, found.run)
    most = np.max(list(shares.values()), axis=0)[-len(one.lines.tension) :]
    where = "used" if len(shares) == 1 else f"largest utilisation ({', '.join(shares)})"
    made = quantities(f"lines at {bow(one):.4g}°", {
        "line.tension": (one.lines.tension, "N", "tension"),
        "line.grounded": (lines.grounded_length, "m", "on the bed"),
        "line.used": (most, "%", where),
    }, "line")  # fmt: skip
    made |= quantities("", {"line.breaking_load": (one.point.system.breaking_load, "N", "breaking load")}, "line")
    return made | quantities("", {"allowable": (float(found.study.allowable), "%", "allowable")}), {}


def cycle_of(found):
    """The limit cycle, if the body slews"""
    c = found.cycle
    if c is None:
        return {}, {}
    pull = np.linalg.norm(c.hawser, axis=1)
    made = quantities("limit cycle", {
        "cycle.amplitude": (c.amplitude, "rad", "heading amplitude"),
        "cycle.middle": (float(turned(c.middle)), "rad", "of"),
        "cycle.period": (c.period, "s", "period"),
        "cycle.least_pull": (pull.min(), "N", "least pull"),
        "cycle.largest_pull": (pull.max(), "N", "largest pull"),
        "cycle.largest_line": (c.lines.max(), "N", "largest line"),
    })  # fmt: skip
    made |= records({
        "cycle.state": (c.states, ("in_cycle", "state"), "m, m, rad, m/s, m/s, rad/s", "state of the body"),
        "cycle.hawser": (c.hawser, ("in_cycle", "hawser"), "N", "pull"),
        "cycle.lines": (c.lines, ("in_cycle", "line"), "N", "tension"),
    })  # fmt: skip
    names = ["x", "y", "heading", "ahead", "to port", "turning"]
    return made, labels("in_cycle", c.time, "s", "time") | labels("state", names)


def run_of(found):
    """A run in time: statistics of tensions and heading, and its records"""
    run = found.run
    if run is None:
        return {}, {}
    r, c, title = run.record, run.cycle, f"{run.record.time[-1]:.6g} s in time"
    made = {
        f"run.{name}": Quantity(values, ("rope",), "N", words, table)
        for name, values in ropes_of(run).items()
        for words, table in [_of_rope(name, title, run.drifts)]
    }
    made |= quantities(f"{title}, motion", {
        "run.amplitude": (float(c.amplitude), "rad", "heading amplitude at the end"),
        "run.period": (float(c.period), "s", "period at the end"),
        "run.settled": (float(run.settled), "s", "time to come within 0.2° of rest"),
        "run.excursion": (watch_circle(r.buoy, run.steady.point.origin), "m",
                          "buoy, largest distance from its place without the hull"),
        "run.radius": (float(run.radius), "m", "watch circle about the buoy at rest, radius"),
    })  # fmt: skip
    wave, motions = wave_deviations(r, run.full_waves), ["surge", "sway", "heave", "roll", "pitch", "yaw"]
    made["run.wave_sigma"] = Quantity(
        wave, ("motion",), tuple(3 * ["m"] + 3 * ["rad"]), "standard deviation",
        "motion in the waves" if np.any(wave > 0) else "",
    )  # fmt: skip
    made |= records({
        "run.place": (r.place, ("time", "xy"), "m", "centre of mass in slow motion"),
        "run.heading_in_time": (r.heading, ("time",), "rad", "heading in slow motion"),
        "run.wave_motion": (r.wave, ("time", "motion"), "m, m, m, rad, rad, rad", "motion in the waves"),
        "run.buoy": (r.buoy, ("time", "xy"), "m", "buoy"),
        "run.hawser_tension": (r.hawser, ("time", "hawser"), "N", "tension"),
        "run.line_tension": (r.lines, ("time", "line"), "N", "tension"),
        "run.wind_speed": (r.wind_speed, ("time",), "m/s", "wind"),
    })  # fmt: skip
    ropes = [*hawsers_of(found.point), *found.point.system.line_names]
    return made, labels("rope", ropes) | labels("time", r.time, "s") | labels("motion", motions)


def _of_rope(name, title, drifts):
    """Description and table of a column; that with the report's fifth is shown if the run lacks slow drift"""
    if name != "significant_with_drift":
        return name, title
    return "significant + 20 %", "" if drifts else title


def maps_of(found):
    """Growth of the slewing over numbers of the study"""
    made, axes = {}, {}
    for i, one in enumerate(found.maps, 1):
        over = " and ".join(one.keys)
        known = one.growth[~np.isnan(one.growth)]
        made[f"map_{i}.slews"] = Quantity(
            float(np.mean(known > 0)), (), "", f"map over {over}: slewing", "maps", share=True
        )
        for name, unit in (("growth", "1/s"), ("period", "s"), ("heading", "rad")):
            values = np.radians(one.heading) if name == "heading" else getattr(one, name)
            made[f"map_{i}.{name}"] = Quantity(
                values, (f"map_{i}_y", f"map_{i}_x"), unit, f"{name} over {over}", record=True
            )
        axes |= labels(f"map_{i}_x", one.x, "", one.keys[0]) | labels(f"map_{i}_y", one.y, "", one.keys[-1])
    return made, axes


def hull_of(found):
    """Data of a run for a film: sizes of the hull, its middle and the ends of hawsers from the centre of mass"""
    h, point, at = found.study.hull, found.point, found.study.attachment
    freeboard = 0.5 * h.draft if h.freeboard is None else h.freeboard
    middle = point.ends.mean(axis=0) - [at.x, at.y]
    return {
        "hull.size": Quantity([h.length, h.beam, h.draft, freeboard], ("size",), "m", "size of the hull"),
        "hull.middle": Quantity(middle, ("xy",), "m", "middle of the hull"),
        "hawser.end": Quantity(point.ends, ("hawser", "xy"), "m", "end on the hull"),
        "water.depth": Quantity(float(found.study.water.depth), (), "m", "depth of the water"),
        "water.density": Quantity(float(point.system.density), (), "kg/m3", "density of the water"),
    }, labels("size", ["length", "beam", "draft", "freeboard"])


def notes_of(found):
    """Notes in addition to tables: the buoy's draft, where slewing begins or ends, and on the run"""
    one = found.best
    yield from pulled_down(found.study.buoy, found.point.system, one)
    if one.quartic is not None:
        low, high = (part * one.lateral.length for part in REACH)
        turn = ", ".join(f"{length:.4g} m" for length in yaw_of(one).lengths) or "none"
        yield f"slewing begins or ends at effective line lengths of {turn} (range {low:.3g} to {high:.3g} m)"
    if found.run is not None:
        yield from running.words(found.run)
