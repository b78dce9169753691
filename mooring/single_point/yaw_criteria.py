"""Published criteria for the yaw stability of a ship at a single point, in addition to the quartic (`criterion`).

static a > N_ψ/Y_ψ: the attachment lies ahead of the point where the side force due to a small heading acts.
Behind it the
               heading diverges without oscillation to one of two oblique headings (a pitchfork), for any length of the
               hawser.  D > 0 of the quartic.  Papoulias and Bernitsas, Journal of Ship Research 32 (1988); Leite
               et al.,
               Applied Ocean Research 20 (1998)
straight line  Y_v N_r − N_v (Y_r − MU) > 0, for a free-running ship, about its centre of mass: Abkowitz, "Stability
               and motion control of ocean vehicles" (1969).  MI times the limit of B for a long line with a small pull,
               as for the towed ship of Strandhagen, Schoenherr and Kobayashi, Transactions of SNAME 58 (1950)
hawser         ABC − C² − A²D > 0 (Routh and Hurwitz), as in Wichers, "A simulation model for a single point moored
               tanker" (Delft 1988) and Sharma, Jiang and Schellin (17th Symp. on Naval Hydrodynamics, 1988): where a
               length of the line changes its sign a limit cycle begins (Hopf)

Y_r of `Lateral` refers to the motion over the ground, in axes that do not turn; −MU with the added mass converts it to
the ship's axes.
"""

from typing import NamedTuple

import numpy as np

from .criterion import Lateral, moored_quartic, routh_hurwitz


class YawStability(NamedTuple):
    """lever : N_ψ/Y_ψ ahead of the centre of mass, m, nan without a side force; static : whether a exceeds the lever

    straight_line : Y_v N_r − N_v (Y_r − MU), (N s/m)(N m s), above 0 for a ship that keeps a straight line
    lengths : (k,) m, rising, the given lengths at which Routh and Hurwitz's condition changes its sign
    """

    lever: float
    static: bool
    straight_line: float
    lengths: np.ndarray


def yaw_stability(lateral: Lateral, speed, lengths) -> YawStability:
    """YawStability of a Lateral; speed : m/s, ahead through the water

    lengths : lengths of the line between which sign changes are sought, (n,) m, ascending
    """
    m = lateral
    lever = m.N_psi / m.Y_psi if m.Y_psi != 0 else np.nan
    lengths = np.asarray(lengths, float)
    return YawStability(
        float(lever), bool(m.arm * m.Y_psi > m.N_psi), float(straight_line(m, speed)), changes(m, lengths)
    )


def straight_line(m: Lateral, speed):
    """Y_v N_r − N_v (Y_r − MU) of a free-running ship at `speed`, m/s, from derivatives by motion over the ground"""
    return m.Y_v * m.N_r - m.N_v * (m.Y_r - m.mass * speed)


def changes(m: Lateral, lengths):
    """Lengths between rising lengths (n,), m, at which a line becomes stable or unstable, m; shape (k,)"""
    from scipy.optimize import brentq

    def margin(length):
        quartic = moored_quartic(m._replace(length=length))
        _, A, B, C, D = np.moveaxis(quartic, -1, 0)
        return A * B * C - C * C - A * A * D

    stable = routh_hurwitz(moored_quartic(m._replace(length=np.asarray(lengths, float))))
    found = []
    for i in np.flatnonzero(stable[1:] != stable[:-1]):
        low, high = lengths[i], lengths[i + 1]
        if margin(low) * margin(high) < 0:
            found.append(brentq(margin, low, high, xtol=1e-9 * high))
    return np.array(found)
