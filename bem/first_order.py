"""First-order quantities of one frequency, in the form in which all methods return them."""

from typing import NamedTuple

import numpy as np


class FirstOrder(NamedTuple):
    """Moments and rotations are about the origin at the centre of the waterplane; SI.

    Signs are those of `bem`; quantities that were not requested are zero.

    Shapes are for m headings and t angles; Kochin functions are H and dH/dθ, per metre or radian of motion, and per
    metre of wave amplitude.
    """

    radiation: np.ndarray  # (6, 6) complex A + iB/ω
    froude_krylov: np.ndarray  # (m, 6) complex N/m, N m/m
    diffraction: np.ndarray  # (m, 6) complex
    haskind: np.ndarray  # (m, 6) complex, excitation from the radiation potentials
    kochin_radiation: np.ndarray  # (2, 6, t) complex m/m, m/rad
    kochin_diffraction: np.ndarray  # (2, m, t) complex
    residual: float  # relative residual of the linear systems
