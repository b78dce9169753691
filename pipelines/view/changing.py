"""`hakobune mesh`: scale, turn, move, mirror, cut or fold a mesh file, or reverse its normals."""

import math

from hakobune.meshing.files import WRITABLE, read_mesh, write_mesh
from hakobune.meshing.mirror import folded, healed
from hakobune.meshing.panels import SYMMETRIES
from hakobune.meshing.quality import findings
from hakobune.meshing.quality.outer import outer as reached
from hakobune.meshing.quality.outward import outward
from hakobune.mooring.criteria.failing import fails

from ..common.outputs import check_ending
from ..printing.verdict import tell
from ..scene.scene import numbers


def change(place, output, scale="1", turn="0", move="0,0,0", flip=False, mirror="", clip=False, outer=False,
           fold=False, heal=0.0):  # fmt: skip
    """Write a changed mesh and print its content and faults; 1 if an error remains.  Raises ValueError.

    The changes are made in the order of the arguments.
    heal : m, points closer than this are merged, before all other changes; scale : a factor or three
    flip : reverse the normals; where they point to different sides, turn them all out of the body
    turn : degrees about z, or about x, y and z in this order, such as 180,0,0 for a hull drawn z down
    move : m, x,y,z; mirror : x, y or xy, planes whose images are
    added; clip : keep only the part below z = 0; outer : keep only panels with water on one side;
    fold : keep a half or quarter if images complete the hull
    """
    from hakobune.bem.database.file import check_place

    if mirror not in SYMMETRIES:
        raise ValueError(f"--mirror is {mirror!r}; allowed: x, y, xy")
    check_ending(output, WRITABLE)
    check_place(output)
    if output.exists() and output.resolve() == place.resolve():
        raise ValueError(f"{output} is the mesh itself; give another name by --output")
    factors = _finite("--scale", scale, (1, 3), "a factor above 0, or three")
    if min(factors) <= 0:
        raise ValueError(f"--scale is {scale!r}; allowed: one or three factors above 0")
    shift = _finite("--move", move, (3,), "three distances in m, such as 0,0,-2")
    angles = _finite("--turn", turn, (1, 3), "degrees about z, or about x,y,z")
    turn = dict(zip("xyz"[-len(angles) :], map(math.radians, angles), strict=True))
    if not 0 <= heal < math.inf:
        raise ValueError(f"--heal is {heal:g}; allowed: a distance in m, 0 or more")
    mesh = read_mesh(place)
    if heal:
        mesh = healed(mesh, heal)
    mesh = _changed(mesh, factors, turn, shift, flip, mirror, clip, outer, fold)
    write_mesh(mesh, output)
    print(f"{output}: {mesh!r}")
    return tell(
        (fails(f"{output}: {one.text}") if one.severity == "error" else f"{output}: {one}" for one in findings(mesh)),
        remark="",
    )


def _finite(flag, text, counts, allowed):
    values = numbers(flag, text)
    if not isinstance(values, list) or len(values) not in counts or not all(map(math.isfinite, values)):
        raise ValueError(f"{flag} is {text!r}; allowed: {allowed}")
    return values


def _changed(mesh, factors, turn, shift, flip, mirror, clip, outer, fold):
    mesh = mesh.scaled(factors)
    for axis, angle in turn.items():
        mesh = mesh.rotated(angle, axis) if angle else mesh
    mesh = mesh.moved(*shift) if any(shift) else mesh
    mesh = outward(mesh) if flip else mesh
    for axis in mirror:
        mesh = mesh.mirrored(axis)
    mesh = mesh.clipped() if clip else mesh
    mesh = reached(mesh) if outer else mesh
    if not fold:
        return mesh
    half = folded(mesh)
    if half.symmetry == mesh.symmetry:
        raise ValueError(
            "--fold: the hull is not symmetric about x = 0 or y = 0; leave out --fold, or use --heal and --move"
        )
    return half
