"""Response of a breakwater over frequencies for each holding: fixed, free, on taut lines or on elastic lines."""

from typing import NamedTuple

import numpy as np

from hakobune.bem.waves import group_factor, wavenumber

from .elastic import elastic_exact
from .exact import fixed_exact, free_exact, moved_to_origin, taut_exact
from .long_waves import FixedBody, fixed_body, line_tensions
from .taut import taut_long_wave

HOLDINGS = ("fixed", "free", "taut", "elastic")


class Response(NamedTuple):
    """Complex amplitudes per unit wave amplitude, (n,) over frequency.

    transmission, reflection : m/m; sway, heave : of the centre of gravity, m/m; roll : rad/m
    front, back : amplitudes of tension P_F and P_B, N/m²; nan for a holding without lines, or without results for them
    """

    transmission: np.ndarray
    reflection: np.ndarray
    sway: np.ndarray
    heave: np.ndarray
    roll: np.ndarray
    front: np.ndarray
    back: np.ndarray


def mean_drift(response, omega, depth, *, density, gravity, obliquity=0.0):
    """Mean horizontal force (n,) towards +y per amplitude squared, N/m³, from the far field (Longuet-Higgins 1977)

    ½ρg n cos²θ (1 + K_R² − K_T²), n = C_g/C; without losses ρg n cos²θ K_R²; obliquity : θ with the normal, rad
    """
    n = group_factor(wavenumber(omega, depth, gravity), depth) * np.cos(obliquity) ** 2
    return density * gravity * n / 2 * (1 + abs(response.reflection) ** 2 - abs(response.transmission) ** 2)


def fixed_response(body, angle=None):
    """`Response` of a `FixedBody`; angle : angle of the lines that hold the body, rad, below π/2, or None"""
    still, without = np.zeros_like(body.transmission), np.full_like(body.transmission, np.nan + 0j)
    lines = (without, without) if angle is None else line_tensions(body.horizontal, body.vertical, angle)
    return Response(body.transmission, body.reflection, still, still, still, *lines)


def exact_response(holding, sections, body, angle=None, axial_stiffness=None):
    """`Response` by potential theory at the frequencies of `sections`.

    holding : one of HOLDINGS; sections : (n,) `Section` at the body's draft
    body : `FloatingBody` if free, `TautBody` on lines, None if fixed; angle : angle of the lines of a fixed body;
        axial_stiffness : N per metre
    """
    if holding == "fixed":
        flows = [fixed_exact(section) for section in sections]
        return fixed_response(FixedBody(*np.array(flows).T), angle)
    nothing = complex(np.nan, 0)
    rows = []
    for section in sections:
        if holding == "free":
            free = free_exact(body, section)
            rows.append((free.transmission, free.reflection, *free.motion, nothing, nothing))
        elif holding == "taut":
            taut = taut_exact(body, section)
            rows.append((taut.transmission, taut.reflection, taut.sway, 0.0, taut.roll, taut.front, taut.back))
        else:
            held = elastic_exact(body, section, axial_stiffness)
            rows.append((held.transmission, held.reflection, *held.motion, held.front, held.back))
    return Response(*np.array(rows, complex).T)


def response_with_loss(holding, flows, body, coefficient, amplitude, angle=None, axial_stiffness=None):
    """`Response` of a rectangle with head loss under the keel, including motions and tensions.

    flows : (n,) `bem.sections.keel_loss.KeelFlow`; coefficient : C; amplitude : amplitude of the waves, m; all other
        arguments as in `exact_response`. The resistance κ = (2C/3πω) a |U| is found with the motion that it damps.
    """
    from scipy.optimize import brentq

    rows = []
    for flow in flows:
        unit = 2 * coefficient * amplitude / (3 * np.pi * flow.section.omega)

        def held(kappa, flow=flow):
            return exact_response(holding, [flow.resisted(kappa)], body, angle, axial_stiffness)

        def more(kappa, held=held, flow=flow, unit=unit):
            motion = np.array([part[0] for part in held(kappa)[2:5]])
            about_origin = motion if body is None else moved_to_origin(body.z0) @ motion
            return kappa - unit * abs(flow.through(about_origin) / (1 - 1j * kappa * flow.own))

        kappa = 0.0 if unit == 0 else brentq(more, 0.0, _bracket(more, unit), rtol=1e-10)
        rows.append([part[0] for part in held(kappa)])
    return Response(*np.array(rows, complex).T)


def _bracket(function, start):
    """A number, from `start` on by factors of four, at which an increasing function is above 0"""
    while function(start) <= 0:
        start *= 4
    return start


def long_wave_response(holding, half, draft, depth, omega, water, angle=None, body=None):
    """`Response` by the theory of Ito and Chiba, of a fixed rectangle or of a `TautRectangle` `body`.

    half, draft, depth : m; omega : (n,) rad/s; water : {"density", "gravity"}; angle : angle of the lines of a fixed
    body
    """
    if holding == "fixed":
        return fixed_response(fixed_body(half, draft, depth, omega, **water), angle)
    taut = taut_long_wave(body, omega)
    still = np.zeros_like(taut.transmission)
    return Response(taut.transmission, taut.reflection, taut.sway, still, taut.roll, taut.front, taut.back)
