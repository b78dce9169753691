"""Damping of slow surge, sway and yaw of a body in time: by wave drift, by radiated waves, and as given in a study.

Each part is a fraction ζ = B/2√(CM) of critical damping at the natural period. Radiated waves damp slow motion very
little (B → 0 with ω). The σ of slow motion, proportional to 1/√ζ, therefore depends on the other two parts. With
coefficients at one wave frequency, as in the SR179 report (1982), the damping at this frequency replaces the damping
at low frequency. A box of 100 m in 20 m of water has 5e6 N s/m at 0.6 rad/s and 2e4 N s/m at 0.05 rad/s.
"""

import numpy as np

from .tables.interpolation import ring_table
from .tables.wave_windows import HEADINGS

PLANE = (0, 1, 5)
SLOW = 0.5  # natural frequencies below this fraction of the mean wave frequency count as slow
TOO_MUCH = 2.0  # largest damping over that at the natural frequency
LIGHT = 0.02  # damping ratio below which slow motion counts as lightly damped


def drift_damping_ring(omega, slopes, weather):
    """Damping B, N s/m …, over headings of the body: (surge, sway, yaw) by (surge, sway), in its axes; shape
    (HEADINGS + 3, 6)

    omega : (q,) rad/s; slopes : B in unit waves at omega, (q, HEADINGS, 3, 2) (`wave_loads.drift_damping`).
    Wave drift damping (`mooring.response.wave_drift_damping`) of all seas together, from the drift of `WaveForces`.
    The damping acts on the slow velocity over ground. The drift B V that a current adds at rest is part of the drift of
    `wave_loads.wave_table`.
    """
    headings, B = np.arange(HEADINGS) * (2 * np.pi / HEADINGS), slopes.reshape(len(omega), HEADINGS, 6)
    if weather.regular is not None:
        w = weather.regular
        place = np.clip(w.omega, omega[0], omega[-1])
        one = np.array([[np.interp(place, omega, B[:, j, c]) for c in range(6)] for j in range(HEADINGS)])
        turned = np.mod(w.direction - headings, 2 * np.pi)
        rows = [np.interp(turned, headings, one[:, c], period=2 * np.pi) for c in range(6)]
        return ring_table((0.5 * w.height) ** 2 * np.stack(rows, axis=-1))
    total = np.zeros((HEADINGS, 6))
    for sea in weather.seas:
        mean = 2 * np.trapezoid(B * np.asarray(sea.spectrum.density(omega))[:, None, None], omega, axis=0)
        for i, heading in enumerate(headings):
            total[i] += sea.directional(headings + heading) @ mean
    return ring_table(total)


def shares(moored, damping, drift_damping):
    """{motion: (natural frequency, rad/s, fraction by `damping` (n, n), by memory, by wave drift (N, 3, 2))},
    uncoupled
    """
    out = {}
    mass = moored.reader.inertia + moored.slow_added_mass
    for i, name in enumerate(moored.reader.words):
        if i % 6 not in PLANE or i >= moored.reader.rigid:
            continue
        stiffness = moored.stiffness[i, i]
        if stiffness > 0:
            omega, critical = np.sqrt(stiffness / mass[i, i]), 2 * np.sqrt(stiffness * mass[i, i])
            radiated = _radiated(moored, omega)[i, i]
            drift = drift_damping[i // 6, i % 6, i % 6] if i % 6 < 2 else 0.0
            out[name] = omega, damping[i, i] / critical, radiated / critical, drift / critical
    return out


def _radiated(moored, omega):
    """Damping by radiation at omega, rad/s; shape (n, n); without a memory that of the nearest frequency of the
    database"""
    if moored.memory.states:
        return moored.memory.transform(np.array([omega]))[0].real
    return moored.reader.coefficients(np.clip([omega], *moored.reader.between.span))[1][0]


def findings(moored, body, mean, constant, dragged):
    """Findings on slow motion that is overdamped by constant coefficients, or lightly damped.

    body : `equation.Body`; mean : mean frequency of the waves, rad/s; constant : whether coefficients are those at
        `mean`
    dragged : whether the hull has drag in the water, which is a further damping
    """
    drift = body.drift_damping[:, 1].reshape(-1, 3, 2)
    own = {name: v for name, v in shares(moored, moored.damping, drift).items() if v[0] < SLOW * mean}
    if constant:
        found = {name: part + by_drift for name, (_, part, _, by_drift) in shares(moored, body.damping, drift).items()}
        much = [
            f"{name} {100 * found[name]:.3g} for {100 * sum(parts):.3g} % of critical at {2 * np.pi / omega:.3g} s"
            for name, (omega, *parts) in own.items()
            if found[name] > TOO_MUCH * sum(parts)
        ]
        if much:
            longest = max(2 * np.pi / own[name][0] for name in own if found[name] > TOO_MUCH * sum(own[name][1:]))
            beside = ", in addition to the drag of the water" if dragged else ""
            yield (
                'left out: the memory of the water; memory = "constant" gives slow motion the damping at '
                f"{mean:.3g} rad/s: {', '.join(much)}{beside}; its σ is therefore too small; give "
                'memory = "states", or where a quay refuses it compare with a run of constant_period = '
                f"{longest:.3g}, which has the damping of slow motion"
            )
        return
    still = dragged or np.any(body.quadratic.reshape(-1, 6)[: len(drift), PLANE] > 0)
    light = [
        f"{name} {100 * sum(parts):.3g} % of critical at {2 * np.pi / omega:.3g} s"
        for name, (omega, *parts) in own.items()
        if sum(parts) < LIGHT and not still
    ]
    if light:
        yield (
            f"slow motion is lightly damped: {', '.join(light)}; give the drag of lines and hull as "
            "simulation.damping_ratio or quadratic_damping"
        )
