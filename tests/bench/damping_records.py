"""How far noise moves the damping of synthetic records: median, ninth decile and worst error, and the share inside.

    python tests/bench/damping_records.py [--records 200]

Records are those of the tests: a ferry in surge of 60 s, ten minutes; noise on motion and force, a share of their
standard deviations.  Beside B₁ and B₂ of a forced oscillation stands the least σ that noise of the force alone allows
any unbiased estimate (Cramér and Rao), in shares of each; and what an estimate with that σ, Gaussian as that of least
squares is, does in as many records: the share within what is asked, 2Φ(asked/σ) − 1, and the median of the worst,
σ Φ⁻¹((1 + 2^(−1/n))/2).  Where that share is below 1, no unbiased estimate keeps the asked in every record.
"""

import argparse
import sys
from pathlib import Path

import numpy as np
from scipy.stats import norm

sys.path.insert(0, str(Path(__file__).parents[2]))

from hakobune.mooring.identification.decay import decay
from hakobune.mooring.identification.forced import forced
from tests.mooring.identification import test_identification as made

ASKED = {0.0: 1e-6, 0.01: 0.02, 0.05: 0.10}


def errors_of_forced(noise, records):
    """(records, 3) errors of B₁, B₂ and the coefficient of the same energy, in shares"""
    share = 8 / (3 * np.pi) * made.OMEGA * made.X
    exact = np.array([made.B1, made.B2, made.B1 + share * made.B2])
    found = [forced(*made.moved(noise, seed)) for seed in range(records)]
    return np.abs(np.array([(one.linear, one.quadratic, one.same_energy) for one in found]) / exact - 1)


def errors_of_decay(noise, records):
    """The same of free decay, β₁, β₂ and β₁ + (8/3π) ωX β₂"""
    share = 8 / (3 * np.pi) * made.OMEGA * made.X
    exact = np.array([made.LINEAR, made.QUADRATIC, made.LINEAR + share * made.QUADRATIC])
    still, out = made.free_decay(), []
    for seed in range(records):
        chance = np.random.default_rng(seed).standard_normal(len(made.TIME))
        one = decay(made.TIME, still + noise * still.std() * chance)
        out.append((one.linear, one.quadratic, one.linear + share * one.quadratic))
    return np.abs(np.array(out) / exact - 1)


def bound(noise):
    """Least standard errors of B₁ and B₂ in shares"""
    t, _, F = made.moved()
    v = made.X * made.OMEGA * np.cos(made.OMEGA * t + 0.3)
    columns = np.stack([made.X * made.OMEGA**2 * np.sin(made.OMEGA * t + 0.3), v, v * np.abs(v), np.ones_like(t)], 1)
    return noise * F.std() * np.sqrt(np.diag(np.linalg.inv(columns.T @ columns)))[1:3] / [made.B1, made.B2]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--records", type=int, default=200)
    count = parser.parse_args().records
    for noise, asked in ASKED.items():
        for word, errors in (("forced", errors_of_forced), ("decay", errors_of_decay)):
            found = errors(noise, count if noise else 1)
            for name, one in zip(("linear", "quadratic", "same energy"), found.T, strict=True):
                inside, tenth = 100 * np.mean(one <= asked), np.quantile(one, 0.9)
                print(
                    f"noise {100 * noise:g} %, {word}, {name}: median {np.median(one):.2g}, nine of ten {tenth:.2g}, "
                    f"worst {one.max():.2g}; within {asked:g}: {inside:.0f} %"
                )
        if noise:
            least = bound(noise)
            within = 100 * (2 * norm.cdf(asked / least) - 1)
            worst = least * norm.ppf(0.5 * (1 + 2 ** (-1 / count)))
            print(
                f"noise {100 * noise:g} %, the bound, linear and quadratic: σ {least.round(4)}, within {asked:g} "
                f"{within.round(0)} %, worst of {count} {worst.round(3)}"
            )
