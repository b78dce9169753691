"""The box of the series calculations: convergence, and the approach of long boxes to the 2-D tables.

Research on the design of box-type shallow-water floating structures (SR179 report, 1982), Tables 2.1.5.1 and
2.1.3.1 to 2.1.3.8.
"""

import csv
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box

G, RHO = 9.80665, 1025.0
XI_B = np.array([0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 2.75])
WANT = frozenset({"added_mass", "radiation_damping", "excitation_force", "drift_force_fixed"})
TABLES = Path(__file__).parents[1] / "published" / "sections_2d.csv"


@lru_cache
def series(depth, **mesh):
    """`flat` of the box of the series calculations at four frequencies and headings"""
    return flat(sweep(np.sqrt(2 * G * XI_B[::3] / 50), depth, np.radians([0, 30, 60, 90]), **mesh))


def sweep(omegas, depth, headings, length=100.0, **mesh):
    hull = box(length, 50, 10, **mesh)
    body = prepare(PanelProblem(hull, lid(hull), depth=depth))
    results = [solve_frequency(body, w, headings, WANT) for w in omegas]
    return {name: np.array([r[name] for r in results]) for name in WANT}


def flat(results):
    """Every coefficient that symmetry does not make zero, (frequencies, coefficients)."""
    i, j = [0, 1, 2, 3, 4, 5, 0, 1], [0, 1, 2, 3, 4, 5, 4, 3]
    force = results["excitation_force"].transpose(0, 2, 1).reshape(len(results["excitation_force"]), -1)
    drift = results["drift_force_fixed"][:, :, :2].reshape(len(force), -1)
    return np.concatenate([results["added_mass"][:, i, j], results["radiation_damping"][:, i, j], force, drift], axis=1)


@pytest.mark.parametrize("depth", [12.0, 20.0, np.inf])
def test_five_hundred_panels_are_within_one_per_cent(depth):
    coarse, middle, fine = (series(depth, counts=c) for c in ((4, 3, 2), (8, 6, 4), (12, 9, 6)))
    # halving the panels cuts the error to a fifth, so what is left after (12, 9, 6) is a 1/(1.5^2.32 − 1) of the step
    limit = fine + (fine - middle) / (1.5**2.32 - 1)
    largest = np.abs(limit).max(axis=0)
    seen = largest > 1e-3 * np.array([largest[:8].max(), largest[8:16].max(), largest[16:].max()]).repeat(
        [8, 8, len(largest) - 16]
    )
    error = [(np.abs(a - limit).max(axis=0)[seen] / largest[seen]).max() for a in (coarse, middle)]
    assert error[1] < 0.01, error  # 416 panels
    assert np.log2(error[0] / error[1]) > 1.5, error


def test_the_default_panel_count_meets_the_default_tolerance():
    ours, fine = series(20.0, panels=250), series(20.0, counts=(12, 9, 6))
    largest = np.abs(fine).max(axis=0)
    assert (np.abs(ours - fine).max(axis=0)[:16] / largest[:16]).max() < 0.01


def published(depth_ratio):
    with TABLES.open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [r for r in rows if float(r["H_over_d"]) == depth_ratio and float(r["B_over_d"]) == 5]


@pytest.mark.parametrize("depth_ratio", [1.2, 1.4])
def test_long_boxes_approach_the_published_sections(depth_ratio):
    rows = [r for r in published(depth_ratio) if float(r["xi_B"]) in (0.4, 1.0, 2.0, 3.0)]
    omegas = [np.sqrt(2 * G * float(r["xi_B"]) / 50) for r in rows]
    names = ("M_H", "N_H", "N_S", "M_R", "E_H", "E_S")
    table, worst = np.array([[float(r[n]) for n in names] for r in rows]), []
    for ratio in (2, 4, 8):
        length = 50.0 * ratio
        r = sweep(omegas, 10 * depth_ratio, [np.pi / 2], length, counts=(4 + ratio, 4, 4))
        mass, wave = RHO * 500 * length, RHO * G * 25 * length
        A, N = r["added_mass"] / mass, r["radiation_damping"] / np.array(omegas)[:, None, None] / mass
        X = np.abs(r["excitation_force"][:, 0]) / wave
        ours = np.stack([A[:, 2, 2], N[:, 2, 2], N[:, 1, 1], A[:, 3, 3] / 625, X[:, 2], X[:, 1]], axis=1)
        worst.append(np.abs(ours / table - 1).max(axis=0))
    worst = np.array(worst)
    # the ends are two of L/B half beams: their share halves when the length doubles
    assert np.all(worst[2] < 0.75 * worst[0]), worst
    assert np.all(worst[2, [0, 1, 2, 3]] < 0.08), worst
    assert np.all(worst[2, :5] < 0.6 * worst[1, :5]), worst


def test_beyond_the_ends_every_added_length_is_a_section():
    row = next(r for r in published(1.2) if float(r["xi_B"]) == 1.0)
    omega = np.sqrt(2 * G / 50)
    long, longer = (
        sweep([omega], 12.0, [np.pi / 2], length, counts=(n, 4, 4)) for length, n in ((400.0, 16), (800.0, 32))
    )
    section = RHO * 500 * 400.0
    sway = (longer["radiation_damping"] - long["radiation_damping"])[0, 1, 1] / omega / section
    heave = (longer["added_mass"] - long["added_mass"])[0, 2, 2] / section
    assert sway == pytest.approx(float(row["N_S"]), rel=0.02)
    assert heave == pytest.approx(float(row["M_H"]), rel=0.02)
