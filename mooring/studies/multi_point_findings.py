"""What a reader of a multi-point study has to know: one line each, with the number and its limit."""

from __future__ import annotations

import numpy as np

from ..environment.between_waves import between_frequencies, between_headings
from ..lines.catenary.state import State

RESONANCE = (0.7, 1.5)  # natural period over wave period; outside, a light mode is amplified below 2
ROLLING = 1e-4  # rad per m of wave amplitude; less is rounding in waves that do not roll the body
ROLL = (0.85, 1.15)  # of the wave period; there roll without viscous damping is several times too large
NEGLIGIBLE = 0.05  # mooring over hydrostatic stiffness, where free motions are used
TURNED = 0.1  # rad; over that angle the drag coefficients of a box change by a tenth of their largest values
SHALLOW = 20.0  # m; SR179 report, section 5.5.3: there some simulations of its floaters exceeded this method
HORIZONTAL = ("Surge", "Sway", "Yaw")


def findings(result, db):
    """What a reader of the result has to know: one line each, with the number and its limit."""
    waves, current = result.conditions.waves, result.conditions.current
    if current:
        yield from current.table.notes
    if waves:
        yield from _interpolated(db, waves)
        yield from resonances(result, waves.period)
        if db.has_viscous_motions:
            yield "motions and drift hold the viscous damping of the wave height in the database's scene"
        else:
            yield from _rolling(result, waves)
        yield from _stiff_modes(result, np.asarray(db.hydrostatic_stiffness, float))
    yield from _held(result.at_rest)
    yield from _outside_the_method(result, db.water_depth)
    yield from _line_findings(result)


def _interpolated(db, waves):
    """What is a linear guess between stored waves.

    On a box of 100 m × 50 m × 10 m at 8 to 14 s most motions in the middle of a gap of 30° are 5 to 40 % off, small
    ones more, and drift in the middle of a second next to the natural period of roll up to a factor of two.
    """
    i, j, share = between_frequencies(db.omega, waves.period)
    if share > 0:
        low, high = (2 * np.pi / db.omega[n] for n in (j, i))
        yield (
            f"wave period {waves.period:g} s lies between the stored {low:.4g} and {high:.4g} s: drift is a linear "
            "guess there, poor near a resonance; add the period to the scene and solve again"
        )
    m, n, share = between_headings(db.wave_direction, waves.direction)
    if share > 0:
        to, low, high = (np.rad2deg(v) for v in (waves.direction, db.wave_direction[m], db.wave_direction[n]))
        yield (
            f"wave direction {to:.4g}° lies between the stored {low:.4g}° and {high:.4g}°: motions and drift are "
            "linear guesses there; add the direction to the scene and solve again"
        )


def resonances(result, wave_period):
    low, high = RESONANCE
    for state, periods in (("at rest", result.at_rest), ("under the steady forces", result.at_equilibrium)):
        near = [
            f"{name} {value:.3g} s"
            for name, value in zip(periods.names, periods.period, strict=True)
            if name in HORIZONTAL and low <= value / wave_period <= high
        ]
        if near:
            yield (
                f"natural periods {state} near the wave period {wave_period:g} s: {', '.join(near)} lie within "
                f"{low:g} to {high:g} of it; free motions underestimate the tension, simulate in time"
            )


def _rolling(result, waves):
    period = result.at_equilibrium.period[result.at_equilibrium.names.index("Roll")]
    rolls = result.amplitudes[3] > ROLLING * 0.5 * waves.height
    if rolls and ROLL[0] <= period / waves.period <= ROLL[1]:
        yield (
            f"natural period of roll {period:.3g} s lies within {ROLL[0]:g} to {ROLL[1]:g} of the wave period "
            f"{waves.period:g} s: its amplitude {result.amplitudes[3]:.2g} rad has no viscous damping; "
            "motion, drift and tension are too large"
        )


def _stiff_modes(result, hydrostatic):
    k = np.diag(result.equilibrium.stiffness)
    for i, name in ((2, "heave"), (3, "roll"), (4, "pitch")):
        ratio = k[i] / hydrostatic[i, i] if hydrostatic[i, i] > 0 else np.inf
        if ratio > NEGLIGIBLE:
            yield (
                f"{name}: mooring stiffness is {ratio:.2g} of the hydrostatic, limit {NEGLIGIBLE:g}; "
                "motions of the freely floating body are too large there"
            )


def _held(periods):
    held = [
        f"{name} {value:.3g} s"
        for name, value, inside in zip(periods.names, periods.period, periods.inside, strict=True)
        if not inside and np.isfinite(value)
    ]
    if held:
        yield f"natural periods outside the solved frequencies, with added mass of the nearest one: {', '.join(held)}"
    unstable = [n for n, value in zip(periods.names, periods.period, strict=True) if np.isnan(value)]
    if unstable:
        yield f"unstable without waves: {', '.join(unstable)}; the body needs more restoring"


def _outside_the_method(result, depth):
    turn = abs(result.displacement[2])
    if turn > TURNED:
        yield (
            f"the steady forces turn the body by {turn:.2g} rad, limit {TURNED:g}: they and the motions are those "
            "of its heading at rest"
        )
    if result.conditions.waves and depth <= SHALLOW:
        yield (
            f"water depth {depth:g} m is not above {SHALLOW:g} m: there simulations in heavy seas exceed this "
            "method (SR179 report, section 5.5.3); simulate in time"
        )


def _line_findings(result):
    names, lines = np.array(result.system.line_names), result.extreme
    rest, mean = result.rest.lines, result.equilibrium.lines
    beyond = lines.status == State.BEYOND_REACH
    groups = (
        (rest.status == State.SLACK, "slack at rest"),
        ((mean.status == State.SLACK) & (rest.status != State.SLACK), "slack under the steady forces"),
        ((mean.vertical_a < 0) & ~beyond, "lifting the anchor under the steady forces"),
        (
            (lines.vertical_a < 0) & (mean.vertical_a >= 0) & ~beyond,
            "lifting the anchor at the largest tension",
        ),
        (beyond, "beyond reach at the largest displacement: an inextensible line cannot follow, give its EA"),
        ((result.utilisation > 1) & ~beyond, "beyond the breaking load"),
        (
            (result.utilisation > result.allowable) & (result.utilisation <= 1),
            f"above the allowable {result.allowable:g} of the breaking load",
        ),
    )
    for chosen, text in groups:
        if np.any(chosen):
            yield f"{chosen.sum()} of {len(names)} lines {text}: {', '.join(names[chosen])}"
