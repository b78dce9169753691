"""A ship at a berth: its natural periods beside those of the harbour, and its motions window by window."""

from __future__ import annotations

import numpy as np

from hakobune.mooring.criteria.failing import fails

from .file import SUMMARY

PLANE = {"surge": 0, "sway": 1, "yaw": 5}
NEAR = 0.2  # of a harbour's period, within which a natural period is near it
FEWEST = 5  # waves of a window


def natural_periods(moored):
    """(3,) s of small motions of surge, sway and yaw about rest, coupled, each named by its largest share; nan: none

    moored : `mooring.motion.simulation.Moored`.  Friction of fenders, which holds small motions, is left out.
    """
    from scipy.linalg import eigh

    place = list(PLANE.values())
    at = np.ix_(place, place)
    mass, stiffness = (moored.reader.inertia + moored.slow_added_mass)[at], moored.stiffness[at]
    squared, shapes = eigh(0.5 * (stiffness + stiffness.T), 0.5 * (mass + mass.T))
    share, out = np.abs(shapes) * np.sqrt(np.diag(mass))[:, None], np.full(3, np.nan)
    for _ in place:
        mode, column = np.unravel_index(np.argmax(share), share.shape)
        out[mode] = 2 * np.pi / np.sqrt(squared[column]) if squared[column] > 0 else np.nan
        share[mode], share[:, column] = -1.0, -1.0
    return out


def lines_on_periods(periods, harbour):
    """A line on natural periods (3,) s; (lines of findings where one is near a harbour's, s, of a list)"""
    known = {name: T for name, T in zip(PLANE, periods, strict=True) if np.isfinite(T)}
    words = ", ".join(f"{n} {T:.3g} s" for n, T in known.items())
    told = f"natural periods of small motions at the berth: {words or 'none, nothing holds them at rest'}"
    near = [
        f"{name} swings with {T:.3g} s at the berth, the harbour with {own:g} s: it resonates; change pretension or "
        f"stiffness of the ropes until they are {100 * NEAR:g} % apart"
        for name, T in known.items() for own in harbour if abs(T / own - 1) <= NEAR
    ]  # fmt: skip
    return told, near


def lines_on_fenders(file, fenders):
    """A line on the most strained fender, and what fails: those beyond what they may be strained

    Strains are of the fenders themselves, without what a dolphin behind them yields.

    file : open, of a simulation; fenders : sequence of `mooring.motion.contacts.QuayFender`
    """
    names, strained = list(file["quantity"].asstr()[()]), []
    for one in fenders:
        row = dict(zip(SUMMARY, file["summary"][names.index(f"deflection {one.name}")], strict=True))
        strained.append((one.fender.own(row["largest"]) / one.fender.height, one))
    if not strained:
        return "", []
    share, most = max(strained, key=lambda pair: pair[0] / pair[1].fender.own_allowable)
    told = (
        f"fenders: {most.name} is strained most, to {100 * share:.3g} % of its height; allowed: "
        f"{100 * most.fender.own_allowable:.3g} %"
    )
    return told, [
        fails(
            f"{one.name} is pressed to {100 * share:.4g} % of its height; allowed: "
            f"{100 * one.fender.own_allowable:.4g} %; take a larger one or more of them"
        )
        for share, one in strained if share > one.fender.own_allowable
    ]  # fmt: skip


def by_design_spectrum(study, db, body, hull, fenders):
    """A line of the design spectrum method on fenders that alone hold a body; "" where it has no answer or there are
    ropes or lines.

    study : `Study`; body : `Reader`, before a quay where there is one
    fenders : sequence of `QuayFender`, of which those count that the steady loads across push to
    """
    from hakobune.mooring.dolphins.design_spectrum import STATIC, TOTAL, Dolphins, beam_of, limit_height, strains
    from hakobune.mooring.response.viscous import in_sea
    from hakobune.mooring.studies.steady_loads import steady_loads, with_coefficients

    from ..common.weather.seas import family_of, shape_of

    conditions = study.conditions()
    if study.rope or study.lines or study.spreads or study.simulation.record or conditions.sea is None:
        return ""
    if study.waves.swell:  # the limit is that of a height of one system
        return ""
    steady = with_coefficients(conditions, hull, study.water.depth)
    across = sum(load[1] for load in steady_loads(db, hull, steady, study.water.depth).values())
    beam = beam_of(in_sea(body, conditions.sea)[0], conditions.waves.direction)
    density = conditions.sea.spectrum.density(beam.omega)
    side = np.sign(across + 2 * np.trapezoid(beam.drift * density, beam.omega)) or 1.0
    met = [one for one in fenders if one.normal[1] * side > 0.5]
    if not met:
        return ""
    beam, family = beam._replace(drift=side * beam.drift), family_of("waves", study.waves, study.water.depth)
    dolphins = Dolphins(met[0].fender, np.array([one.face for one in met]))
    try:
        s = strains(beam, dolphins, side * across, conditions.sea.spectrum)
    except ValueError as error:
        return f"design spectrum method, {len(met)} fenders: {error}"

    def sea(height, mean_period):
        return family(height, mean_period=mean_period, **shape_of(study.waves))

    limit = limit_height(beam, dolphins, side * across, sea, conditions.waves.period)
    return (
        f"design spectrum method, {len(met)} fenders: static {s.static:.3g} m ({100 * s.static_strain:.3g} %), "
        f"σ {s.sigma:.3g} m, largest {s.largest:.3g} m ({100 * s.strain:.3g} %); allowed: {100 * STATIC:g} and "
        f"{100 * TOTAL:g} %, up to a significant height of {limit:.2f} m"
    )


def check_harbour(periods):
    """The periods.  Raises StudyError."""
    from ..common.quantities import positive

    return [positive(f"harbour.periods[{i}]", T) for i, T in enumerate(periods)]


def windows(motion, step, length):
    """Rows (start s, significant amplitude and period of surge, sway and yaw (6,)) of windows of a record (n, 6)

    Amplitudes are halves of H₁/₃ of the waves between zero crossings about the window's mean, yaw in degrees; nan of
    fewer than FEWEST waves.  A last window that is not whole is left out.
    """
    from hakobune.mooring.environment.crossings import zero_crossings

    count, rows = round(length / step), []
    for i in range((len(motion) - 1) // count):
        part, values = motion[i * count : (i + 1) * count + 1], []
        for name, mode in PLANE.items():
            unit = np.degrees(1.0) if name == "yaw" else 1.0
            try:
                waves = zero_crossings(unit * (part[:, mode] - part[:, mode].mean()), step)
            except ValueError:
                waves = ()
            known = len(waves) >= FEWEST
            values += [0.5 * waves.significant_height, waves.significant_period] if known else [np.nan, np.nan]
        rows.append((i * count * step, values))
    return rows


def check_windows(length, plan):
    """Raise StudyError for windows of `length` s that the records of a `study.Plan` do not have."""
    from ..common.quantities import StudyError

    step, duration = plan.settings.step, plan.settings.duration
    if not FEWEST * step <= length <= duration:
        raise StudyError(f"--windows is {length:g} s; allowed: {FEWEST * step:g} s to the duration, {duration:g} s")
    if plan.keep_series < 1:
        raise StudyError("--windows is given, and no record is stored; allowed: with keep_series of 1 or more")


def windows_table(file, length):
    """The first stored record of an open file in windows of `length` s, as a table"""
    from rich.table import Table

    step = float(np.diff(file["time"][:2])[0])
    table = Table(
        title=f"seed {int(file['kept_seed'][0])} in windows of {length:g} s: significant amplitudes and periods",
        title_justify="left",
    )
    for name in ("from s", "surge m", "T s", "sway m", "T s", "yaw °", "T s"):
        table.add_column(name, justify="right", no_wrap=True)
    for start, values in windows(file["motion"][0].astype(float), step, length):
        table.add_row(f"{start:g}", *("–" if np.isnan(v) else f"{v:.3g}" for v in values))
    return table
