"""Findings on a multi-point study: one line each, with the number and its limit."""

import numpy as np

from hakobune.bem.database.resonances import resonances as known_resonances

from ..criteria.failing import fails
from ..criteria.overuse import overused, shares
from ..lines.catenary.state import State
from ..lines.system.findings import LONGEST_STRAIN, beyond_tables, strains, unheld
from ..response.findings import LINES_NAMED, large_rotations, some

UNSURE = 0.05  # estimated error of a motion or of drift between stored waves above which it is reported
RESONANCE = (0.7, 1.5)  # natural period over wave period; outside, a light mode is amplified below 2
MOVING = 1e-4  # m or rad per m of wave amplitude; less counts as rounding in waves that do not move the body
# natural period over wave period within which a motion without viscous damping is several times too large
NEAR = (0.85, 1.15)
WEAK = 0.1  # ratio of wave damping alone, to which viscous damping adds a tenth to a third
NEGLIGIBLE = 0.05  # mooring over hydrostatic stiffness, where free motions are used
ROUNDING = 1e-6  # force over the largest force, with moments per metre, below which it is rounding
NO_DAMPING = "has no viscous damping"  # text of a finding on a motion at its resonance
IN_TIME = "simulate in time"  # end of findings on the limits of the simplified method
TURNED = 0.1  # rad; over that angle the drag coefficients of a box change by a tenth of their largest values
SHALLOW = 20.0  # m; SR179 report, section 5.5.3: there some simulations of its floaters exceeded this method
HORIZONTAL = ("Surge", "Sway", "Yaw")


def findings(result, db):
    """Findings on the result: one line each, with the number and its limit."""
    waves, current, words = result.conditions.waves, result.conditions.current, db.bodies_reader.words
    if current:
        yield from getattr(current.table, "notes", ())
    if waves:
        irregular = result.conditions.method == "irregular"
        yield from _of_the_sea(result) if irregular else _uncertain(db.bodies_reader, waves)
        yield from () if irregular else result.waves["regular_wave"].warnings
        yield from large_rotations(
            {words[d]: np.degrees(result.amplitudes[d]) for d in range(db.bodies_reader.rigid) if d % 6 > 2}
        )
        yield from resonances(result, waves.period)
        if db.has_viscous_motions:
            yield "motions and drift include the viscous damping of the database's scene, linearised in these waves"
        else:
            yield from _undamped(result, db, waves)
        yield from _stiff_modes(result, db.bodies_reader.stiffness, words[: db.bodies_reader.rigid])
    if result.bent is not None:
        yield (
            "bodies that bend are not trimmed for the weight of their lines at rest, and wind, current and drift have "
            "no force on their shapes"
        )
    yield from _held(result.at_rest)
    yield from _unstable(result)
    yield from _outside_the_method(result, db.water_depth)
    yield from _line_findings(result)


def _uncertain(body, waves):
    """Estimated errors of motions and drift between stored waves, over the largest of their kind in this wave"""
    motion, wrong = (part[0, 0] for part in body.at([waves.omega], "rao", [waves.direction]))
    motion, wrong = motion[: body.rigid], wrong[: body.rigid]
    largest = np.abs(motion).reshape(-1, 2, 3).max(axis=(0, 2))
    largest = np.tile(np.repeat(largest, 3), len(motion) // 6)
    share = wrong / np.maximum(np.abs(motion), largest / 10)
    named = [f"{body.words[i]} {100 * share[i]:.0f} %" for i in np.argsort(-share) if share[i] > UNSURE]
    force, wrong = (part[0, 0] for part in body.at([waves.omega], "drift_force", [waves.direction]))
    for name, part in (("drift force", slice(0, 2)), ("drift moment", slice(2, 3))):
        off = wrong[part].max() / max(np.abs(force[part]).max(), 1e-300)
        named += [f"{name} {100 * off:.0f} %"] if off > UNSURE else []
    if named:
        yield (
            f"waves of {waves.period:g} s towards {np.rad2deg(waves.direction) % 360:.4g}° lie between stored waves; "
            f"the estimated errors are {', '.join(named)}; limit {100 * UNSURE:g} %; add this period and heading to "
            f"the scene"
        )


def _of_the_sea(result):
    effects = result.waves["irregular"]
    yield from effects.warnings
    if effects.slow is None:
        return
    x, y, turn = np.where(np.abs(effects.slow) > ROUNDING * np.max(effects.slow[:2]), effects.slow, 0.0)
    yield (
        f"slow drift about the mean, standard deviations Fx {x / 1e3:.3g}, Fy {y / 1e3:.3g} kN, Mz {turn / 1e3:.3g} "
        f"kN m, moves the body at its natural periods; the tensions do not include this motion: {IN_TIME}"
    )


def resonances(result, wave_period):
    low, high = RESONANCE
    for state, periods in (("at rest", result.at_rest), ("under the steady forces", result.at_equilibrium)):
        near = [
            f"{_worded(name)} {value:.3g} s"
            for name, value in zip(periods.names, periods.period, strict=True)
            if name.split("__")[-1] in HORIZONTAL and low <= value / wave_period <= high
        ]
        if near:
            yield (
                f"natural periods {state} near the wave period {wave_period:g} s: {', '.join(near)} lie within "
                f"{low:g} to {high:g} times this period; free motions underestimate the tension, {IN_TIME}"
            )


def _undamped(result, db, waves):
    """Roll, and heave and pitch with little wave damping, near the wave period"""
    low, high = NEAR
    body = db.bodies_reader
    weak = {one.mode for one in known_resonances(body) if one.damping < WEAK}
    periods = dict(zip(result.at_equilibrium.names, result.at_equilibrium.period, strict=True))
    for mode, name in enumerate(body.names[: body.rigid]):  # hinges leave fewer modes than motions
        if name not in periods or (mode % 6 != 3 and not (mode in weak and mode % 6 in (2, 4))):
            continue
        period, amplitude = periods[name], result.amplitudes[mode]
        size = f"{amplitude:.2g} m" if mode % 6 == 2 else f"{np.degrees(amplitude):.3g}°"
        if amplitude > MOVING * 0.5 * waves.height and low <= period / waves.period <= high:
            yield (
                f"the natural period of {body.words[mode]}, {period:.3g} s, lies within {low:g} to {high:g} of "
                f"the wave period {waves.period:g} s: its amplitude {size} {NO_DAMPING}; motion, drift and "
                "tension are too large; give the scene [viscous], or simulate with damping_ratio"
            )


def _stiff_modes(result, hydrostatic, words):
    k = np.diag(result.equilibrium.stiffness)
    for i, name in ((d, word) for d, word in enumerate(words) if d % 6 in (2, 3, 4)):
        ratio = k[i] / hydrostatic[i, i] if hydrostatic[i, i] > 0 else np.inf
        if ratio > NEGLIGIBLE:
            yield (
                f"{name}: the mooring stiffness is {ratio:.2g} of the hydrostatic stiffness, limit "
                f"{NEGLIGIBLE:g}; motions of the freely floating body are too large there"
            )


def _worded(name):
    """A mode of several bodies, "barge__Roll", in the words used for motions elsewhere"""
    body, _, motion = name.rpartition("__")
    return f"{body} {motion.lower()}" if body else name


def _held(periods):
    held = [
        f"{_worded(name)} {value:.3g} s"
        for name, value, inside in zip(periods.names, periods.period, periods.inside, strict=True)
        if not inside and np.isfinite(value)
    ]
    if held:
        named = ", ".join(held)
        where = "outside the solved frequencies, or near a resonance of the water in a gap"
        yield f"natural periods {where} use the added mass at the nearest good frequency: {named}"


def _unstable(result):
    for where, periods in (("at rest", result.at_rest), ("under the steady forces", result.at_equilibrium)):
        names = [name for name, value in zip(periods.names, periods.period, strict=True) if np.isnan(value)]
        if names:
            yield fails(
                f"the body is unstable {where}, without waves, in: {', '.join(map(_worded, names))}; it needs "
                "more restoring"
            )


def _outside_the_method(result, depth):
    turn = np.abs(result.displacement[2::3]).max()
    if turn > TURNED:
        yield (
            f"the steady forces turn the body by {turn:.2g} rad, limit {TURNED:g}, but forces and motions are "
            "computed at its heading at rest"
        )
    if result.conditions.waves and result.conditions.method == "regular_wave" and depth <= SHALLOW:
        yield (
            f"water depth {depth:g} m is not above {SHALLOW:g} m: in such depths, simulations in heavy seas "
            f"exceed the results of this method (SR179 report, section 5.5.3); {IN_TIME}"
        )


def _line_findings(result):
    names, lines = np.array(result.system.line_names), result.extreme
    rest, mean = result.rest.lines, result.equilibrium.lines
    beyond = lines.status == State.BEYOND_REACH
    laid = np.ones(len(names), bool)
    laid[list(result.system.hawsers)] = False  # hawsers: their anchor may lift
    groups = (
        (rest.status == State.SLACK, "slack at rest"),
        ((mean.status == State.SLACK) & (rest.status != State.SLACK), "slack under the steady forces"),
        (
            unheld(rest) | unheld(mean),
            "slack on a bed that is too steep for their friction, but computed as lying there: give more friction or "
            "less line",
        ),
        (laid & (mean.vertical_a < 0) & ~beyond, "lifting the anchor under the steady forces"),
        (
            laid & (lines.vertical_a < 0) & (mean.vertical_a >= 0) & ~beyond,
            "lifting the anchor at the largest tension",
        ),
        (
            np.isinf(result.system.breaking_load),
            "without a breaking load, so that their utilisation is unknown: give breaking_load of their type",
        ),
    )
    for chosen, text in groups:
        if np.any(chosen):
            yield f"{chosen.sum()} of {len(names)} lines {text}: {some(list(names[chosen]), LINES_NAMED)}"
    yield from beyond_tables(result.system, result.tension)
    yield from _broken(result, beyond)


def _broken(result, beyond):
    """Lines that part, or exceed their allowable share; beyond : (n,) whether out of reach"""
    names, strain = result.system.line_names, strains(result.system, result.tension)
    if np.any(beyond):
        named = some([names[i] for i in np.flatnonzero(beyond)], LINES_NAMED)
        yield fails(
            f"{beyond.sum()} of {len(names)} lines cannot reach the fairlead at the largest displacement, since they "
            f"are inextensible; give EA or more length: {named}"
        )
    stretched = (strain > LONGEST_STRAIN) & ~beyond
    if np.any(stretched):
        yield fails(
            f"{stretched.sum()} of {len(names)} lines are stretched by more than {100 * LONGEST_STRAIN:g} % of their "
            f"length at the largest tension, where any rope parts: "
            f"{shares(names, np.where(stretched, strain, np.nan))}; give a longer line or a nearer anchor"
        )
    yield from overused(names, np.where(beyond, np.nan, result.utilisation), result.allowable, "at the largest tension")
