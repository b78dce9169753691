"""All families of spectra by name: the families of `environment.spectra`, and families that need a depth or have two
peaks."""

from functools import partial

import numpy as np

from ..environment import spectra
from .shallow import tma
from .two_peaks import ochi_hubble, torsethaugen

PEAKED = ("jonswap", "tma")  # spectra with a gamma


def families(depth):
    """{name: function of height, period by kind, and gamma if the family has a gamma}; depth : m, None if unknown

    Raises ValueError from "tma" without a finite depth.
    """
    return {
        **spectra.FAMILIES,
        "tma": partial(_tma, depth=depth),
        "ochi_hubble": ochi_hubble,
        "torsethaugen": torsethaugen,
    }


def _tma(height, depth, **words):
    if depth is None or not np.isfinite(depth):
        raise ValueError("tma needs a finite water depth; give the depth, or use jonswap")
    return tma(height, depth, **words)
