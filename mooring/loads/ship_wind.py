"""Wind on merchant ships by the loading functions of Blendermann (1994), from the silhouette of a hull.

    F_x = −C_l q A_f cos γ / N,   F_y = C_t q A_s sin γ / N,   N = 1 − ½δ (1 − C_l A_f/(C_t A_s)) sin² 2γ
    M_z = 0.18 (π/2 − γ) L F_y,   M_x = κ z_s F_y

γ : angle the wind comes from, 0 ahead; A_f, A_s : front and side area above water; z_s : middle of the side area, which
is assumed amidships.  Coefficients and their source are in `tables/ship_wind.csv`; the wind is uniform over the height.
"""

import numpy as np

from hakobune.meshing.text_files import packaged_rows

from .coefficients import hull_coefficients

STEP = 2.5  # °, of the coefficients


def ships():
    """Names of the types of ship"""
    return tuple(row["ship"] for row in packaged_rows(__package__, "ship_wind"))


def blendermann(ship, length, front_area, side_area, side_height):
    """HullCoefficients of a type of ship; length m, areas m², height of the middle of the side area m above water

    raises : ValueError that names the known types
    """
    known = {row["ship"]: row for row in packaged_rows(__package__, "ship_wind")}
    if ship not in known:
        raise ValueError(f"there are no wind coefficients for a ship of type {ship!r}; allowed: {'; '.join(known)}")
    across, ahead, astern, cross, roll = (float(value) for value in list(known[ship].values())[1:])
    to = np.deg2rad(np.arange(0.0, 180.0 + 0.5 * STEP, STEP))  # direction that the wind blows to, from the bow
    gamma = np.pi - to
    along = np.where(gamma < 0.5 * np.pi, ahead, astern)
    below = 1 - 0.5 * cross * (1 - along * front_area / (side_area * across)) * np.sin(2 * gamma) ** 2
    x, y = -along * np.cos(gamma) / below, across * np.sin(gamma) / below
    y[[0, -1]] = 0.0
    sizes = {"area_x": front_area, "area_y": side_area, "length": length, "height": roll * side_height}
    return hull_coefficients(to, x, y, 0.18 * (0.5 * np.pi - gamma) * y, **sizes)
