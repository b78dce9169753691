"""Scene of a film of a moored body: hull, lines, fenders, a buoy, the bed and the surface, frame by frame."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from hakobune.mooring.lines.system.bodies import rotation

from .gif import BED, HULL, SEA, new_plotter

GRID, WIDTH = 80, 1.6  # points and width of the surface, the width in spans of the lines
POINTS = 40  # points drawn on a line
FENDER, BUOY = "#c07020", "#d0a000"
OF_SPAN = 0.01  # radius of a drawn buoy, for visibility


class Hull(NamedTuple):
    """box : six sides in the hull's coordinates, m; center : point in these coordinates about which the hull
    rotates, (3,) m
    """

    box: tuple
    center: np.ndarray


class Stage(NamedTuple):
    """hulls : (Hull, …); span : m, of anchors and hulls

    depth : m; fenders : fenders of a `mooring.motion.contacts` berth; carriers : numbers of the hulls that carry the
        fenders, below 0 for a quay, or () if all are on quays; rest : poses of the hulls for which the fenders are
        given, (n, 6), m and rad
    """

    hulls: tuple
    span: float
    depth: float
    fenders: tuple = ()
    carriers: tuple = ()
    rest: np.ndarray | None = None


class Scene(NamedTuple):
    """stage : `Stage`; poses : function of motions (n, …) that gives (n, hulls, 6); held : whether there are lines

    threads : function of the motion (…,) of a frame that gives (lines × POINTS, 3) m
    """

    stage: Stage
    poses: Callable
    held: bool
    threads: Callable


def straight(one, other):
    """Places along ropes between points (ropes, 3), m; shape (ropes × POINTS, 3)"""
    along = np.linspace(0, 1, POINTS)[:, None]
    return np.concatenate([np.empty((0, 3)), *(a + (b - a) * along for a, b in zip(one, other, strict=True))])


def moved(center, motion):
    """Poses of one hull by its motions (n, 6), for `frames`; shape (n, 1, 6)"""
    return (np.asarray(motion) + [*center, 0.0, 0.0, 0.0])[:, None]


def frames(stage, at, poses, threads=None, heights=None, buoys=None):
    """Pictures, each (height, width, 3), at times (n,) s.

    poses : position of each hull's center in space, and its rotation, (n, hulls, 6), m and rad

    threads : function of the frame number that returns (lines × POINTS, 3) m; heights : function of x, y (g,) m that
    returns a function of t (s) → (g,) m; buoys : (n, 3) m
    """
    import pyvista

    plotter = new_plotter()
    hulls = [pyvista.Box(hull.box).triangulate() for hull in stage.hulls]
    still = [made.points - hull.center for made, hull in zip(hulls, stage.hulls, strict=True)]
    lines = None if threads is None else _polylines(threads(0))
    side = np.linspace(-0.5, 0.5, GRID) * WIDTH * stage.span
    x, y = (grid.ravel() for grid in np.meshgrid(side, side, indexing="ij"))
    sea = pyvista.StructuredGrid(*(grid.reshape(GRID, GRID, 1) for grid in (x, y, np.zeros_like(x))))
    bed = pyvista.Plane(center=(0, 0, -stage.depth), i_size=WIDTH * stage.span, j_size=WIDTH * stage.span)
    plotter.add_mesh(bed, color=BED)
    rise = None if heights is None else heights(*sea.points[:, :2].T)
    plotter.add_mesh(sea, opacity=0.45, **_colours(sea, rise, at[0]))
    for made in hulls:
        plotter.add_mesh(made, color=HULL)
    if lines is not None:
        plotter.add_mesh(lines, color="#202020", line_width=2)
    fenders = [_fender(one) for one in stage.fenders]
    for made in fenders:
        plotter.add_mesh(made, color=FENDER)
    follow = carried(stage, fenders)
    ball = None if buoys is None else pyvista.Sphere(radius=OF_SPAN * stage.span)
    if ball is not None:
        round_, ball.points = ball.points.copy(), ball.points + buoys[0]
        plotter.add_mesh(ball, color=BUOY)
    plotter.camera_position = [(0.25 * stage.span, -1.0 * stage.span, 0.4 * stage.span), (0, 0, 0), (0, 0, 1)]
    label = plotter.add_text("", font_size=9, color="black")
    try:
        for i, (t, pose) in enumerate(zip(at, poses, strict=True)):
            for made, points, one in zip(hulls, still, pose, strict=True):
                made.points = one[:3] + points @ rotation(*one[3:]).T
            for made, points, hull in follow:
                made.points = pose[hull, :3] + points @ rotation(*pose[hull, 3:]).T
            if lines is not None:
                lines.points = threads(i)
            if ball is not None:
                ball.points = round_ + buoys[i]
            if rise is not None:
                sea["m"] = rise(t)
                sea.points = np.column_stack([*sea.points[:, :2].T, sea["m"]])
            label.set_text("upper_left", f"{t:.1f} s")
            plotter.render()
            yield plotter.screenshot(return_img=True)
    finally:
        plotter.close()


def carried(stage, fenders):
    """[(mesh, its points in axes of the hull, number of the hull)] of the fenders that a hull carries"""
    found = []
    for made, hull in zip(fenders, stage.carriers or (-1,) * len(fenders), strict=True):
        if hull >= 0:
            own = rotation(*stage.rest[hull, 3:])
            found.append((made, (np.array(made.points) - stage.rest[hull, :3]) @ own, hull))
    return found


def _colours(sea, rise, t):
    """Words of `add_mesh` for a surface by its height, from dark troughs to light crests; flat without waves"""
    if rise is None:
        return {"color": SEA}
    sea["m"] = rise(t)
    swing = max(float(np.abs(sea["m"]).max()), 1e-6)
    return {"scalars": "m", "cmap": "ocean", "clim": (-1.6 * swing, 1.6 * swing), "show_scalar_bar": False,
            "smooth_shading": True}  # fmt: skip


def _polylines(points):
    """Lines of POINTS points each"""
    import pyvista

    count = len(points) // POINTS
    cells = np.column_stack([np.full(count, POINTS), np.arange(count * POINTS).reshape(count, POINTS)]).ravel()
    return pyvista.PolyData(points, lines=cells)


def _fender(one):
    """A fender as a cylinder outwards from its face, its length and diameter equal to its height"""
    import pyvista

    height = one.fender.height
    middle = one.face + 0.5 * height * one.normal
    return pyvista.Cylinder(center=middle, direction=one.normal, radius=0.5 * height, height=height)
