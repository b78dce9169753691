"""How far the bound long wave changes slow drift, over the depth: σ of the slow surge force beside Newman's rule alone.

    python tests/bench/bound_to_newman.py --output bound_to_newman.png [--panels 400]

The box of 100 × 50 × 10 m, free, head seas (JONSWAP, 1 m), in 12 and in 20 m of water; kh of the peak from 0.3 to 2,
that is Tp of 23 to 5 s in 12 m.  With the long wave bound to each pair, diffracted by the hull (`bound_wave_drift`),
and the quick estimate of it that studies warn with.
"""

import argparse
import sys
import tempfile
import warnings
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2])]

import numpy as np

from hakobune.bem.database import open_database
from hakobune.bem.waves import wavenumber
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.response.bound_wave_drift import bound_to_newman, of_sea
from hakobune.mooring.response.sea_state import sea_state
from hakobune.pipelines.cli import main

KH = np.geomspace(0.3, 2.0, 9)
G = 9.80665


def ratios(depth, panels, folder):
    """(k,) σ with the bound wave over that of Newman's rule, and (k,) of the estimate, bound wave over Newman's"""
    path = Path(folder) / f"box{depth:g}.h5"
    words = f"box --length 100 --beam 50 --draft 10 --depth {depth:g} --panels {panels} --gyration 15.55,29.44,32.28"
    peaks = np.sqrt(G * KH / depth * np.tanh(KH))
    band = f"{0.6 * peaks[0]:.4g}:{1.6 * peaks[-1]:.4g}:30"
    if main([*words.split(), "--omega", band, "--heading", "0", "--output", str(path)]):
        raise SystemExit(f"{path} is incomplete")
    db = open_database(path)
    body, found = db.reader.floating(), []
    assert np.allclose([wavenumber(w, depth, G) * depth for w in peaks], KH, rtol=1e-6)
    for peak in peaks:
        sea = Sea(jonswap(1.0, peak_period=2 * np.pi / peak), 0.0)
        slow = sea_state(body, sea, 3600.0, bound=of_sea(db, sea)).slow
        found.append((slow.sigma_of_pairs[0] / slow.sigma[0], bound_to_newman(body, sea)))
    return np.array(found, float).T


def draw(rows, path):
    """rows : {depth: (whole, estimate)}"""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 4.4), layout="constrained")
    axes = figure.add_subplot()
    for depth, (whole, estimate) in rows.items():
        (line,) = axes.plot(KH, whole, "o-", ms=4, label=f"{depth:g} m: with bound wave / Newman")
        axes.plot(KH, estimate, "--", color=line.get_color(), label=f"{depth:g} m: bound wave alone / Newman, estimate")
    axes.axhline(1.0, color="k", lw=0.8)
    axes.set(xscale="log", yscale="log", xlabel="kh of the peak", ylabel="ratio of σ, slow surge force")
    axes.set_xticks([0.3, 0.5, 1.0, 2.0], ["0.3", "0.5", "1", "2"])
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    figure.savefig(path, dpi=120)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--panels", type=int, default=400)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as folder:
        rows = {depth: ratios(depth, given.panels, folder) for depth in (12.0, 20.0)}
    for depth, (whole, estimate) in rows.items():
        for kh, a, b in zip(KH, whole, estimate, strict=True):
            print(f"{depth:g} m, kh {kh:.2f}: with bound wave {a:.3f} times Newman's, estimate of its part {b:.3f}")
    draw(rows, given.output)
