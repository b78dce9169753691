"""Two bodies far from each other: each moves as alone in the waves of the sea and those that the other sends.

The far field of one alone, η ~ H √(2/πkR) exp(i(kR − π/4)), is at the other, R away, a plane wave nearly, which it
scatters in its turn; of two along x, in waves of 1 m towards +x,

    u = s [H(0 → 0) + H(180° → 0) v],    v = s H(0 → 180°) (exp(ikR) + u),    s = √(2/πkR) exp(i(kR − π/4))

at the one ahead, u, and at the first, v.  What is left out is of the order of 1/kR of these.  As they die like 1/√R,
a body that sends much is felt far away: at 20 lengths the change is 1 ‰ of the motion at 0.6 and 10 % at 1.2 rad/s.
"""

from itertools import pairwise

import numpy as np
import pytest

import hakobune
from hakobune.bem.database import open_database
from hakobune.bem.waves import wavenumber

BOX = {"shape": "box", "length": 20.0, "beam": 10.0, "draft": 4.0, "gyration": [3.5, 6.0, 6.0]}
DEPTH = 30.0
WAVES = {"omegas": [0.6, 0.9, 1.2], "headings_deg": [0, 180]}
XZ = [0, 2, 4]


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """Motions (w, headings, 6) of one alone, and H (w, headings, θ) of all that it sends"""
    path = tmp_path_factory.mktemp("one") / "one.h5"
    hakobune.solve({"water": {"depth": DEPTH}, "bodies": [BOX], "waves": WAVES, "panels": 100}, path)
    one = open_database(path)
    rao = np.array(one["rao"])
    return rao, np.array(one["kochin_diffraction"]) + rao @ np.array(one["kochin_radiation"])


def felt_by_both(alone, away, path):
    """(w, 2) what each of two feels of the other, over its motion in the sea, the first one first; against their Kochin
    functions"""
    both = [{**BOX, "name": name, "place": [x, 0.0, 0.0]} for name, x in (("near", 0.0), ("far", away))]
    hakobune.solve({"water": {"depth": DEPTH}, "bodies": both, "waves": WAVES, "panels": 200}, path)
    together, changes = np.array(open_database(path)["rao"])[:, 0], []
    for w, X, sent, found in zip(WAVES["omegas"], *alone, together, strict=True):
        k, H = float(wavenumber(w, DEPTH, 9.80665)), sent[:, [0, sent.shape[-1] // 2]]
        there, s = np.exp(1j * k * away), np.sqrt(2 / (np.pi * k * away)) * np.exp(1j * (k * away - np.pi / 4))
        u, v = np.linalg.solve([[1.0, -s * H[1, 0]], [-s * H[0, 1], 1.0]], [s * H[0, 0], s * H[0, 1] * there])
        for own, sea, more in ((found[:6], X[0], v * X[1]), (found[6:], there * X[0], u * X[0])):
            felt = (own - sea)[XZ]
            assert np.all(np.abs(felt - more[XZ]) < 1.5 / (k * away) * np.abs(more[XZ]))
            changes.append(np.abs(felt / sea[XZ]).max())
    return np.reshape(changes, (-1, 2))


def test_bodies_twenty_lengths_apart_feel_the_waves_that_each_sends_alone_and_farther_ones_by_the_root(alone, tmp_path):
    """At 20, 40 and 80 lengths, but for waves that go once more between the two, twice what is felt"""
    felt = [felt_by_both(alone, n * BOX["length"], tmp_path / f"{n}.h5") for n in (20, 40, 80)]
    assert felt[0][0].max() == pytest.approx(8e-4, rel=0.1) and felt[0][-1].max() == pytest.approx(0.1, rel=0.1)
    for nearer, farther in pairwise(felt):
        off = np.abs(farther / nearer * np.sqrt(2) - 1)
        assert np.all(off < 0.01 + 2 * nearer.max(axis=1, keepdims=True)), off
