"""Loads on a body in a run: components of its waves, streams of wind and current, given forces."""

import numpy as np

from ...environment.sea import Components, joined
from ...loads.on_hull import current_on, turning_drag
from ...on_current.body import on_current
from ...on_current.waves import Carrier, in_water, met_by_a_place
from ...response.bound_wave_drift import record as pair_record
from ..given_forces import GivenForce, drift_of_half_waves
from ..streams import calm, current_stream, on_all, stream_of, wind_stream
from ..wave_loads import drift_of
from .failures import SimulationError

NEXT_SEA, GUSTS = 7919, 104729  # added to the seed of a run for each further sea, and for gusts: phases of
# two loads of a run are never equal; those of runs whose seeds differ by this number would be
FEWEST, MOST = 200, 600  # wave components of a sea; with 600 their beats are closer than the width of a slow resonance


def wave_components(moored, weather, settings, seed):
    """Components of the weather's waves, or None; enough for a record that does not repeat."""
    place = weather.carrier, moored.reader.depth, moored.reader.gravity
    if weather.regular is not None:
        w = weather.regular
        one = Components(*(np.array([float(v)]) for v in (w.omega, 0.5 * w.height, 0.0, w.direction)))
        return in_water(one, *place)
    if not weather.seas:
        return weather.components
    parts = []
    for number, sea in enumerate(weather.seas):
        low, high, count = _band(moored, sea, settings)
        parts.append(sea.components(count, seed + NEXT_SEA * number, low=low, high=high))
    return in_water(parts[0] if len(parts) == 1 else joined(*parts), *place)


def _band(moored, sea, settings):
    """Lowest and highest frequency of the components of a sea, rad/s, and their number"""
    band = np.clip(sea.spectrum.quantile((1e-5, 1 - 1e-3)), moored.reader.omega[0], moored.reader.omega[-1])
    count = settings.components
    if count is None:
        count = int(np.clip(np.ptp(band) * settings.duration / (4 * np.pi), FEWEST, MOST))
    return *map(float, band), count


def mean_frequency(components):
    """Mean frequency of the energy of wave components, rad/s"""
    energy = components.amplitude**2
    return float(components.omega @ energy / energy.sum())


def frequency_of_coefficients(settings, components):
    """Frequency of the coefficients of memory = "constant", rad/s: from the given period, else the waves' mean
    period, else None
    """
    if settings.constant_period:
        return 2 * np.pi / settings.constant_period
    return None if components is None else mean_frequency(components)


def streams(moored, weather, seed, end):
    """Wind and current as `Stream`s up to `end` s (the current is None without drag of the water), N₂ of yaw (N,),
    and findings.

    raises : SimulationError for a missing hull, or for an unknown drag of the water
    """
    reader, own, hulls = moored.reader, weather.on_hull, moored.hulls
    wind = calm(len(reader.axes_at_rest))
    if own is not None:
        if weather.wind is not None and own.wind is not None:
            speed, to = weather.wind.speed, weather.wind.direction
            wind = stream_of(own.wind, speed, to, weather.gusts, seed + GUSTS, 0.0, end)
        return wind, calm(), own.quadratic, ()
    if not hulls:
        if weather.wind or weather.current:
            raise SimulationError(
                "wind and current need the dimensions of the hull; give its length, beam and freeboard"
            )
        return wind, None, 0.0, ()
    if weather.wind:
        blown = weather.gusts, seed + GUSTS, 0.0, end
        wind = on_all([wind_stream(weather.wind, one.box, one.rotation_center, *blown) for one in hulls])
    try:
        water = [current_on(weather.current, one.box, reader.density, reader.depth) for one in hulls]
        current = [
            current_stream(weather.current, one.box, one.rotation_center, reader.density, reader.depth) for one in hulls
        ]
        drag = np.array([turning_drag(part, one.box.length) for part, one in zip(water, hulls, strict=True)])
        notes = tuple(dict.fromkeys(note for part in water for note in part.notes)) if weather.current else ()
        return wind, on_all(current), drag, notes
    except ValueError as error:
        if weather.current:
            raise SimulationError(str(error)) from None
        return wind, None, 0.0, (f"slow motion has no drag of the water: {error}",)


def pairs(moored, weather, settings, components):
    """Slow force of wave pairs in addition to Newman's approximation: a GivenForce for each sea with such a force

    components : components of all seas of the weather, one after another; with several bodies, a tuple of forces for
        each sea
    """
    first, at_rest = 0, moored.reader.axes_at_rest
    for sea, forces in zip(weather.seas, weather.beside_newman, strict=bool(weather.beside_newman)):
        *_, count = _band(moored, sea, settings)
        own, first = Components(*(part[first : first + count] for part in components)), first + count
        if forces is None:
            continue
        met = met_by_a_place(own, weather.carrier, moored.reader.depth, moored.reader.gravity)
        each = forces if isinstance(forces, tuple) else (forces,)
        for body, (of_pairs, waves) in enumerate(zip(each, moored.waves.each, strict=True)):
            heading = at_rest[body, 5] + moored.start[6 * body + 5]
            drift = None if waves.drift is None else drift_of(waves, own, heading)
            t, force = pair_record(of_pairs, own, settings.ramp + settings.duration, drift, met)
            yield GivenForce(t - settings.ramp, force, body, smooth=True)


def half_waves(moored, weather, settings, components):
    """Slow drift of a run by half waves: (GivenForce,), or () if the run does not use half waves"""
    if settings.slow_drift != "half-waves" or components is None or not moored.reader.knows_drift:
        return ()
    if moored.reader.bodies:
        raise ValueError('slow_drift is "half-waves" with several bodies; allowed: "newman", "mean", "none"')
    carrier, heading = weather.carrier, moored.start[5]
    if carrier is not None:
        cos, sin, (x, y) = np.cos(heading), np.sin(heading), carrier.velocity
        carrier = Carrier((cos * x + sin * y, cos * y - sin * x))  # in the axes of the body
    body = on_current(moored.reader, carrier)
    return (drift_of_half_waves(body, components, heading, settings.ramp, settings.duration),)
