"""The camera of `hakobune look`: as close as possible with everything in view.

With x to the right, y up and z towards the camera, which is at a distance D from the origin, a point is inside the
right side of the picture, of slope t, if x − c ≤ t (D − z).  Both sides of all points together give the least D, max(x
+ tz) + max(−x + sz) = (t + s) D, and the place c across; the upper and the lower side follow in the same way.
"""

import math

import numpy as np

MARGINS = 0.05, 0.05, 0.05, 0.22  # left, right, below and above, of half the picture; the caption is above
BAR = 0.40  # space on the right for a colour bar
DEEP = 2.0  # depth of a drawn bed, over the hull's diagonal


def fit(plotter, hull, bar=False):
    """Move the camera of a pyvista Plotter, in its direction, until everything drawn is in the picture.

    hull : PanelMesh; a sea bed far below it may be outside the picture; bar : whether a colour bar is drawn
    """
    points = np.vstack([mesh.points for mesh in plotter.meshes])
    corners = hull.whole().vertices.reshape(-1, 3)
    reach = DEEP * float(np.linalg.norm(np.ptp(corners, axis=0)))
    shown = points[points[:, 2] >= corners[:, 2].min() - reach]
    camera = plotter.camera
    axes = _axes(np.array(camera.direction), np.array(camera.up))
    left, right, below, above = 1.0 - np.array(MARGINS)
    slope = math.tan(math.radians(camera.view_angle) / 2)
    wide = slope * plotter.window_size[0] / plotter.window_size[1]
    x, y, z = axes @ shown.T
    across = _sides(x, z, wide * left, wide * (right - BAR if bar else right))
    up = _sides(y, z, slope * below, slope * above)
    distance = max(_distance(across), _distance(up))
    place = np.array([_middle(across, distance), _middle(up, distance), distance]) @ axes
    plotter.camera_position = [tuple(place), tuple(place - distance * axes[2]), tuple(axes[1])]


def _axes(direction, up):
    """Axes of the camera in rows: to the right, up and towards the camera; shape (3, 3)"""
    back = -direction / np.linalg.norm(direction)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(back, right), back])


def _sides(x, z, low, high):
    """Slopes of both sides, and the largest offset of the points from them at zero distance"""
    return low, high, float(np.max(-x + low * z)), float(np.max(x + high * z))


def _distance(sides):
    low, high, out_low, out_high = sides
    return (out_low + out_high) / (low + high)


def _middle(sides, distance):
    """Place of the camera with equal margins on both sides"""
    low, high, out_low, out_high = sides
    return ((out_high - high * distance) + (low * distance - out_low)) / 2
