"""Sectional coefficients of a rectangle, beam B and draft d, in two dimensions, in water of any depth.

    A + iB/ω = −ρ ∮ φⱼ nᵢ dl,    F = −iρω ∮ (φ_I + φ_D) nᵢ dl,    φ_I = −(ig/ω) Z₀ exp(iky)

per metre of length, for sway, heave and roll in this order: y to port, z up, roll from y to z about the origin at the
middle of the waterline, exp(−iωt), waves towards +y, unit amplitude.  φⱼ is the potential of unit velocity.  Finite
depth by matched eigenfunctions (`finite_depth`), deep water by an integral equation (`deep_water`).

Exciting forces and radiated waves are related by (Haskind 1957; Newman 1975; n = C_g/C)

    F = ±2iρg (n/k) η,     B = 2ρg (n/kω) |η|²,     |R|² + |T|² = 1,     R = ½(e^{2iε_H} + e^{2iε_S})

with η the elevation radiated towards +y per unit motion, and the sign − for heave, + for sway and roll.  For waves at
an angle θ to the normal, and for motions that vary as exp(ikx sinθ) along the body, n cosθ replaces n. The tables
2.1.3.1-20 of the SR179 report (1982) follow from a `Section` by `report_row`.
"""

from typing import NamedTuple

import numpy as np

from ..problem import check_gap
from ..waves import group_factor, wavenumber

SWAY, HEAVE, ROLL = range(3)
TOLERANCE = 1e-6
FINEST = 1e-8
MOST_TERMS = 12
DEEPEST = 300  # kd
MOST_OBLIQUE = np.radians(89.9)
ALONG = 1e-4  # sinθ below which waves count as normal: error 1e-8, less than the digits that its square would lose
MODES_PER_LENGTH = ((1e-3, 25), (1e-5, 50), (1e-6, 100), (FINEST, 400))


class Section(NamedTuple):
    """Coefficients of one section at one frequency, per metre of its length; see the module for signs.

    beam, draft, depth : m; omega : rad/s; density : kg/m³; gravity : m/s²; k : rad/m
    added_mass : (3, 3) kg/m, kg, kg m; damping : (3, 3) kg/(m s) …
    excitation : force on the fixed body per unit amplitude, by diffraction, complex, N/m² and N/m, (3,)
    haskind : excitation from the radiated flows by Haskind's relation, (3,)
    radiated : elevation far away towards +y, referred to y = 0, per unit amplitude of motion, complex, m/m and m/rad,
        (3,)
    reflection, transmission : coefficients R and T of the fixed body, complex, referred to y = 0
    drift : mean sway force on the fixed body per amplitude squared, N/m³
    radiated_back : elevation as `radiated`, towards −y, (3,); obliquity : angle θ of the waves with the normal, rad
    """

    beam: float
    draft: float
    depth: float
    omega: float
    density: float
    gravity: float
    k: float
    added_mass: np.ndarray
    damping: np.ndarray
    excitation: np.ndarray
    haskind: np.ndarray
    radiated: np.ndarray
    reflection: complex
    transmission: complex
    drift: float
    radiated_back: np.ndarray
    obliquity: float = 0.0


def section(beam, draft, depth, omega, *, density=1025.0, gravity=9.80665, tolerance=TOLERANCE, obliquity=0.0):
    """`Section` of a rectangle at one frequency.

    beam, draft : m; depth : m, may be inf; omega : rad/s
    obliquity : θ of waves and motions that vary as exp(ikx sinθ) along the body, rad; for finite depth only
    tolerance : relative error; the error of sway–roll coupling is relative to √(sway · roll)
    raises : ValueError if the tolerance cannot be reached
    """
    flow = section_flow(beam, draft, depth, omega, gravity=gravity, tolerance=tolerance, obliquity=obliquity)
    impedance = radiation(flow, density)
    reflected, transmitted = flow.reflection_transmission()
    n = float(group_factor(flow.k, depth)) * np.cos(obliquity)
    radiated = omega**2 / gravity * np.array([flow.radiated_wave(mode) for mode in range(3)])
    return Section(
        beam, draft, depth, omega, density, gravity, flow.k,
        added_mass=impedance.real,
        damping=omega * impedance.imag,
        excitation=-1j * density * omega * flow.wave_exciting,
        haskind=2j * density * gravity * n / flow.k * np.array([1, -1, 1]) * radiated,
        radiated=radiated,
        reflection=complex(reflected),
        transmission=complex(transmitted),
        drift=density * gravity * n * np.cos(obliquity) * abs(reflected) ** 2,
        radiated_back=np.array([-1, 1, -1]) * radiated,
        obliquity=obliquity,
    )  # fmt: skip


def section_flow(beam, draft, depth, omega, *, gravity=9.80665, tolerance=TOLERANCE, obliquity=0.0):
    """The radiated and diffracted flows of a section, accurate to `tolerance`.  Raises ValueError."""
    check_shape(beam, draft, depth, tolerance)
    if not 0 < omega < np.inf:
        raise ValueError(f"omega is {omega:g} rad/s; allowed: above 0 and finite")
    kd = float(wavenumber(omega, depth, gravity)) * draft
    if kd > DEEPEST:
        raise ValueError(
            f"omega is {omega:g} rad/s, and wavenumber times draft is {kd:.0f}; allowed: up to {DEEPEST}, "
            "beyond which waves are negligible: use bem.sections.frequency_limits.added_mass_limit"
        )
    if not abs(obliquity) <= MOST_OBLIQUE:
        raise ValueError(
            f"obliquity is {np.degrees(obliquity):.4g}°; allowed: up to ±{np.degrees(MOST_OBLIQUE):.4g}, since "
            "waves along an infinitely long body pass it undisturbed"
        )
    if np.isinf(depth) and obliquity:
        raise ValueError(
            f"obliquity is {np.degrees(obliquity):.4g}° in deep water; allowed: obliquity 0, or a finite depth"
        )
    if np.isinf(depth):
        from .deep_water import DeepFlow

        return DeepFlow(beam, draft, omega, gravity, tolerance)
    from .finite_depth import FiniteDepthFlow

    terms, modes = effort(beam, draft, depth, tolerance)
    sine = float(np.sin(abs(obliquity)))
    return FiniteDepthFlow(beam, draft, depth, omega, gravity, terms, modes, sine if sine > ALONG else 0.0)


def effort(beam, draft, depth, tolerance):
    """Numbers of functions per family and of modes per smallest length with which the error is within the tolerance.

    With P functions per family, and a gap whose height is r times the smaller of draft and half beam, the measured
    error is below 10^(−6 (P − 1) / √r) for r ≤ 120, 0.3 ≤ B/d ≤ 100 and 0.02 ≤ ξ_B ≤ 3.
    """
    ratio = (depth - draft) / min(draft, beam / 2)
    terms = 1 + int(np.ceil(-np.log10(tolerance) / 6 * np.sqrt(max(ratio, 1.0))))
    if terms > MOST_TERMS:
        limit = (6 * (MOST_TERMS - 1) / np.log10(tolerance)) ** 2
        raise ValueError(
            f"depth − draft is {ratio:.0f} times the smaller of draft and half beam; allowed: up to {limit:.0f} at "
            f"tolerance {tolerance:g}, or depth inf"
        )
    return terms, next((count for finest, count in MODES_PER_LENGTH if tolerance >= finest))


def radiation(flow, density):
    """Radiation A + iB/ω, kg/m, kg, kg m; shape (3, 3)"""
    out = np.zeros((3, 3), complex)
    for i, j in ((SWAY, SWAY), (SWAY, ROLL), (ROLL, SWAY), (ROLL, ROLL), (HEAVE, HEAVE)):
        out[i, j] = -density * flow.force(flow.radiated[j], i)
    return out


def diffraction(flow, density, sines):
    """Diffraction force iρω ∮ φⱼ ∂φ_I/∂n dl (Haskind) per metre, for φ_I = −(ig/ω) Z₀ exp(iky sinβ); shape (m, 3)

    sines : sinβ of the waves, (m,)"""
    return 1j * density * flow.omega * flow.haskind_integral(sines)


def report_row(section):
    """The columns of the SR179 report's (1982) tables 2.1.3.1-20, by name, preceded by the arguments of the row.

    ξ_B = ω²b/g, b = B/2, S = Bd.  M_H and M_S are divided by ρS, M_R by ρS b², M_SR by ρS b; N is divided in the
    same way and by ω; E_H and E_S are divided by ρg b, E_R by ρg b²; ε is in degrees.  Further columns are |R| and
    |T| of the fixed body, and the drift divided by ρg/2.
    """
    b, area = section.beam / 2, section.beam * section.draft
    row = {
        "H_over_d": section.depth / section.draft,
        "B_over_d": section.beam / section.draft,
        "xi_B": section.omega**2 * b / section.gravity,
    }
    for name, i, j, arm in (("H", HEAVE, HEAVE, 0), ("S", SWAY, SWAY, 0), ("R", ROLL, ROLL, 2), ("SR", SWAY, ROLL, 1)):
        unit = section.density * area * b**arm
        row[f"M_{name}"] = section.added_mass[i, j] / unit
        row[f"N_{name}"] = section.damping[i, j] / (unit * section.omega)
    for name, i, arm in (("H", HEAVE, 1), ("S", SWAY, 1), ("R", ROLL, 2)):
        force = section.excitation[i] / (section.density * section.gravity * b**arm)
        row[f"E_{name}"], row[f"eps_{name}_deg"] = abs(force), np.degrees(np.angle(force))
    row |= {"reflected": abs(section.reflection), "transmitted": abs(section.transmission)}
    return row | {"drift": section.drift / (0.5 * section.density * section.gravity)}


def check_shape(beam, draft, depth, tolerance):
    """Raise ValueError for lengths that form no section, or for a tolerance that cannot be reached."""
    for name, value in (("beam", beam), ("draft", draft)):
        if not 0 < value < np.inf:
            raise ValueError(f"{name} is {value:g} m; allowed: above 0 and finite")
    if not depth > draft:
        raise ValueError(f"depth is {depth:g} m at draft {draft:g} m; allowed: above the draft, or inf")
    check_gap(draft, depth)
    if not FINEST <= tolerance < 1:
        raise ValueError(f"tolerance is {tolerance:g}; allowed: {FINEST:g} to below 1")


def frequency_of(xi, beam):
    """ω of ξ_B = ω²B/2g, rad/s"""
    return np.sqrt(2 * 9.80665 * np.asarray(xi, float) / beam)
