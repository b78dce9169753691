"""Two-dimensional rectangle of beam B and draft d in water of finite depth, exact by matched eigenfunctions.

The two regions of `two_regions` over y > 0, in symmetric (heave) and antisymmetric (sway, roll) flow, b = B/2:

    outside   R₀ = 1/ik,  Rₙ = −1/kₙ;     beneath   T_q = coth(l_q b)/l_q  or  tanh(l_q b)/l_q,  T₀ = b

y right, z up, roll from y to z, moments about the waterline's centre, exp(−iωt); waves run towards +y.
Normalised as in "Research on the design of box-type shallow-water floating structures" (SR179 report, 1982),
Tables 2.1.3.1-20, with ξ_B = ω²b/g and S = Bd:

    M_H, M_S over ρS, M_R over ρS b², M_SR over ρS b;  N likewise and over ω;  E_H, E_S over ρg b, E_R over ρg b².
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .gap_modes import Gap
from .two_regions import Motion, TwoRegions

MODES = ("H", "S", "R")


@dataclass(frozen=True)
class Rectangle:
    """beam, draft, depth : m; omega : rad/s; forces are per metre of length; terms, modes : see `Gap`"""

    beam: float
    draft: float
    depth: float
    omega: float
    density: float = 1025.0
    gravity: float = 9.80665
    terms: int = 20
    modes: int = 60

    @cached_property
    def gap(self):
        return Gap(self.draft, self.depth, self.omega, self.beam / 2, self.gravity, self.terms, self.modes)

    @property
    def k(self):
        """rad/m"""
        return self.gap.k

    def _motion(self, mode):
        b, s = self.beam / 2, self.gap.height
        if mode == "H":  # ψ = (ζ² − y²) / 2s
            return Motion(value=(-b * b / (2 * s), 1 / (2 * s)), slope=(-b / s, 0.0))
        if mode == "S":
            return Motion(side=(1.0, 0.0))
        # ψ = (yζ² − y³/3) / 2s
        return Motion((0.0, -1.0), (-(b**3) / (6 * s), b / (2 * s)), (-b * b / (2 * s), 1 / (2 * s)))

    def _bottom(self, mode):
        """∫ ψ ∂ψ/∂z dy over half the bottom"""
        b, s = self.beam / 2, self.gap.height
        return {"H": b * (s * s - b * b / 3), "S": 0.0, "R": b**3 * (s * s / 3 - b * b / 15)}[mode] / (2 * s)

    @cached_property
    def _symmetric(self):
        return self._regions(0.0, 1 / np.tanh(self.gap.inner_wavenumbers * self.beam / 2), True)

    @cached_property
    def _antisymmetric(self):
        return self._regions(self.beam / 2, np.tanh(self.gap.inner_wavenumbers * self.beam / 2), False)

    def _regions(self, mean_ratio, ratios, symmetric):
        gap = self.gap
        outside = gap.outside(-1j / self.k, -1 / gap.outer_wavenumbers, 0.0)
        beneath = gap.beneath(mean_ratio, ratios / gap.inner_wavenumbers, 0.0)
        return TwoRegions(gap, outside, beneath, symmetric)

    def _regions_of(self, mode):
        return self._symmetric if mode == "H" else self._antisymmetric

    @cached_property
    def _radiated(self):
        return {mode: self._regions_of(mode).flow(self._motion(mode)) for mode in MODES}

    @cached_property
    def _diffracted(self):
        """Flow of the symmetric and antisymmetric part of the incident wave with what the fixed body adds"""
        drive = -1j * self.gravity / self.omega * np.exp(-1j * self.k * self.beam / 2)
        return self._symmetric.flow(drive=drive), self._antisymmetric.flow(drive=-drive)

    def impedance(self, i, j):
        """M + iN/ω between modes "H", "S", "R": force along i by motion j, kg/m, kg, kg m"""
        if (i == "H") != (j == "H"):
            return 0j
        bottom = self._bottom(i) if i == j else 0.0
        return -2 * self.density * self._regions_of(j).pressure(self._radiated[j], self._motion(i), bottom)

    def excitation(self, mode):
        """Complex force per unit amplitude on the fixed body, N/m per m"""
        flow = self._diffracted[mode != "H"]
        integral = self._regions_of(mode).pressure(flow, self._motion(mode))
        return -2j * self.density * self.omega * integral

    def radiated_wave(self, mode):
        """Complex amplitude at y → ∞, referred to y = 0, per unit velocity of `mode`"""
        outgoing = self._regions_of(mode).wave(self._radiated[mode]) / (1j * self.k)
        return 1j * self.omega / self.gravity * outgoing * np.exp(-1j * self.k * self.beam / 2)

    @cached_property
    def reflection_transmission(self):
        """Complex R and T of the fixed body, referred to y = 0"""
        even, odd = self._diffracted
        back, amplitude = np.exp(-1j * self.k * self.beam / 2), -1j * self.gravity / self.omega
        share = 2 / (1j * self.k * amplitude)
        even = back * (back + share * self._symmetric.wave(even))
        odd = back * (-back + share * self._antisymmetric.wave(odd))
        return (even - odd) / 2, (even + odd) / 2

    def table(self):
        """The report's columns for one ξ_B, by name"""
        b, area = self.beam / 2, self.beam * self.draft
        row = {}
        for name, i, j, arm in (("H", "H", "H", 0), ("S", "S", "S", 0), ("R", "R", "R", 2), ("SR", "S", "R", 1)):
            value = self.impedance(i, j) / (self.density * area * b**arm)
            row[f"M_{name}"], row[f"N_{name}"] = value.real, value.imag
        for mode, arm in (("H", 1), ("S", 1), ("R", 2)):
            value = self.excitation(mode) / (self.density * self.gravity * b**arm)
            row[f"E_{mode}"], row[f"eps_{mode}_deg"] = abs(value), np.degrees(np.angle(value))
        return row
