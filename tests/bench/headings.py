"""Short-crested and long-crested seas on databases of few headings against sums over directions of one degree.

    python tests/bench/headings.py database.h5 [--seas 200] [--seed 1]

The database holds the series box (100 × 50 × 10 m in 20 m) with headings every 5° from 0 to 90°, as by

    hakobune box --length 100 --beam 50 --draft 10 --depth 20 --gyration 15.55,29.44,32.28 --omega auto:0.2:1.6
        --heading 0,5,10,15,20,25,30,35,40,45,50,55,60,65,70,75,80,85,90 --output database.h5

Of every sea (JONSWAP, Tp 6 to 14 s, any direction; long crests, cos², cos⁴, cos²⁰, wrapped normal 10°) the motions,
mean drift, its moment, slow drift and wave drift damping from every third or sixth of the headings are compared with
those from all, summed over 360 directions.  Good is a quantity within 1e-3, or within the error that the command
prints for it.  Forces are relative to the larger one, the moment to at least 5 % of radius times force.
"""

import argparse
import sys
import warnings
from dataclasses import replace
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.bem.database import open_database
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.environment.spreading import CosinePower, WrappedNormal
from hakobune.mooring.response.linear import frequencies
from hakobune.mooring.response.sea_state import sea_state
from hakobune.mooring.response.slow_drift import force_spectrum, held_beyond, signed_means
from hakobune.mooring.response.wave_drift_damping import drift_and_damping, mean_damping

CIRCLE = np.radians(np.arange(360.0))
SPREADINGS = {
    "long crests": None,
    "cos2": CosinePower(2.0),
    "cos4": CosinePower(4.0),
    "cos20": CosinePower(20.0),
    "normal 10": WrappedNormal(np.radians(10.0)),
}
QUANTITIES = ("motions", "mean drift", "moment of drift", "slow drift", "damping")
CLOSE, LEVER = 1e-3, 0.05


def of_steps(body, step):
    """The same body known at headings every `step` degrees"""
    between = body.between
    kept = np.flatnonzero(np.abs((np.degrees(between.headings) + 1e-6) % step) < 1e-3)
    by_heading = ("excitation_force", "Froude_Krylov_force", "diffraction_force", "drift_force", "drift_force_fixed")
    by_heading += ("kochin_diffraction", "rao", "pressure")
    some = {name: v[:, kept] if name in by_heading else v for name, v in between.quantities.items()}
    return replace(body, between=replace(between, headings=between.headings[kept], quantities=some))


def summed(body, sea):
    """σ (6,), mean drift (3,), σ of slow drift (3,), damping (2, 2) by 360 directions"""
    heading, share = np.array([sea.direction]), np.ones(1)
    if sea.spreading is not None:
        heading, share = CIRCLE, sea.spreading.density(np.mod(CIRCLE - sea.direction + np.pi, 2 * np.pi) - np.pi)
        share = share / share.sum()
    omega = frequencies(body, sea.spectrum.density)
    S, X = sea.spectrum.density(omega)[:, None], body.motions(omega, heading)
    sigma = np.sqrt(np.trapezoid(np.einsum("qpj,p->qj", np.abs(X) ** 2, share) * S, omega, axis=0))
    D, B = drift_and_damping(body, omega, heading)
    mean = 2 * np.trapezoid(np.einsum("qpj,p->qj", D, share) * S, omega, axis=0)
    difference = np.linspace(0, 0.2, 81)
    parts = held_beyond(omega, signed_means(D, share), sea.spectrum)
    slow = np.trapezoid(force_spectrum(sea.spectrum, *parts, difference), difference, axis=0)
    return sigma, mean, np.sqrt(slow), mean_damping(omega, B, S[:, 0], share)[:2]


def compared(body, few, sea):
    """Errors (5, …) of the quantities and those that are said"""
    found, (sigma, mean, slow, damping) = sea_state(few, sea, 3600.0), summed(body, sea)
    force = max(np.abs(mean[:2]).max(), 1e-300)
    of_slow = max(slow[:2].max(), 1e-300)
    drift = found.slow.drift - found.slow.beyond.sum(axis=0) - mean
    seen = sigma > 1e-3 * np.repeat([sigma[:3].max(), sigma[3:].max()], 3)
    errors = (
        np.abs(found.sigma[:6] / np.where(seen, sigma, 1.0) - 1)[seen],
        np.abs(drift[:2]).max() / force,
        np.abs(drift[2]) / max(abs(mean[2]), LEVER * body.radius * force),
        np.abs(found.slow.sigma - slow)[:2].max() / of_slow,
        np.abs(found.slow.damping[:2] - damping).max() / np.abs(damping).max(),
    )
    said = found.errors
    return errors, (said.motions[seen], said.drift[0], said.drift[1], said.drift[0], said.damping)


def run(body, seas, seed):
    """Print the shares of seas that are right, and the largest errors"""
    rng, few = np.random.default_rng(seed), {step: of_steps(body, step) for step in (15, 30)}
    rows = {step: [] for step in few}
    for i in range(seas):
        step = (15, 30)[i % 2]
        spreading = list(SPREADINGS.values())[rng.integers(len(SPREADINGS))]
        sea = Sea(jonswap(2.0, peak_period=rng.uniform(6, 14)), rng.uniform(0, 2 * np.pi), spreading)
        rows[step].append(compared(body, few[step], sea))
    for step, found in rows.items():
        for q, name in enumerate(QUANTITIES):
            error = np.array([np.max(errors[q]) for errors, _ in found])
            good = np.mean([np.all(errors[q] <= np.maximum(CLOSE, said[q])) for errors, said in found])
            close = np.mean(error <= CLOSE)
            print(
                f"{step:2d}° {name:16s} within 1e-3 {100 * close:5.1f} %, or what is said {100 * good:5.1f} %, "
                f"median error {100 * np.median(error):7.3f} %, largest {100 * error.max():6.2f} %"
            )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("database", type=Path)
    parser.add_argument("--seas", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    run(open_database(given.database).reader.floating(), given.seas, given.seed)
