"""Two bodies far from each other: each moves as alone in the waves of the sea and those that the other sends.

The far field of one alone, η ~ H √(2/πkR) exp(i(kR − π/4)), is at the other, R away, a plane wave nearly, which it
scatters in its turn; of two along x, in waves of 1 m towards +x,

    u = s [H(0 → 0) + H(180° → 0) v],    v = s H(0 → 180°) (exp(ikR) + u),    s = √(2/πkR) exp(i(kR − π/4))

at the one ahead, u, and at the first, v.  What is left out is of the order of 1/kR of these.  As they die like 1/√R,
a body that sends much is felt far away: here the change is 1 ‰ of the motion at 0.6 and 10 % at 1.2 rad/s.
"""

import numpy as np
import pytest

import hakobune
from hakobune.bem.database import open_database
from hakobune.bem.waves import wavenumber

BOX = {"shape": "box", "length": 20.0, "beam": 10.0, "draft": 4.0, "gyration": [3.5, 6.0, 6.0]}
AWAY, DEPTH = 400.0, 30.0
WAVES = {"omegas": [0.6, 0.9, 1.2], "headings_deg": [0, 180]}
XZ = [0, 2, 4]


def test_bodies_twenty_lengths_apart_feel_the_waves_that_each_sends_alone(tmp_path):
    water = {"depth": DEPTH}
    hakobune.solve({"water": water, "bodies": [BOX], "waves": WAVES, "panels": 100}, tmp_path / "one.h5")
    both = [{**BOX, "name": name, "place": [x, 0.0, 0.0]} for name, x in (("near", 0.0), ("far", AWAY))]
    hakobune.solve({"water": water, "bodies": both, "waves": WAVES, "panels": 200}, tmp_path / "two.h5")
    one, two = open_database(tmp_path / "one.h5"), open_database(tmp_path / "two.h5")
    alone, together = np.array(one["rao"]), np.array(two["rao"])[:, 0]
    sent = np.array(one["kochin_diffraction"]) + alone @ np.array(one["kochin_radiation"])
    changes = []
    for w, X, H, found in zip(WAVES["omegas"], alone, sent[..., [0, sent.shape[-1] // 2]], together, strict=True):
        k = float(wavenumber(w, DEPTH, 9.80665))
        there, s = np.exp(1j * k * AWAY), np.sqrt(2 / (np.pi * k * AWAY)) * np.exp(1j * (k * AWAY - np.pi / 4))
        u, v = np.linalg.solve([[1.0, -s * H[1, 0]], [-s * H[0, 1], 1.0]], [s * H[0, 0], s * H[0, 1] * there])
        for own, sea, more in ((found[:6], X[0], v * X[1]), (found[6:], there * X[0], u * X[0])):
            felt = (own - sea)[XZ]
            assert np.all(np.abs(felt - more[XZ]) < 1.5 / (k * AWAY) * np.abs(more[XZ]))
            changes.append(np.abs(felt / sea[XZ]).max())
    assert changes[0] == pytest.approx(8e-4, rel=0.1) and changes[-1] == pytest.approx(0.1, rel=0.1)
