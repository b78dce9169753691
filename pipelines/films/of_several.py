"""Several bodies of a simulation as `of_run` shows them: hulls as boxes, lines and ropes between them, fixed bodies."""

import tomllib
from functools import partial
from typing import NamedTuple

import numpy as np

from hakobune.bem.database import open_database
from hakobune.mooring.lines.system.bodies import rotation

from ..moor.study import box_of, make_study
from ..simulate.file import database_path
from .stage import POINTS, Hull, Scene, Stage, straight

AROUND = 1.5  # of the largest hull, of the picture beyond the places of the bodies


class Moored(NamedTuple):
    """names : names of the moving bodies; at_rest : poses of these bodies at rest, (N, 6), m and rad; system :
    system of lines, or None

    ends : [(points (ropes, 3) m in space at rest, numbers (ropes,) of the bodies that carry them, below 0 for none)]
    """

    names: list
    at_rest: np.ndarray
    system: object
    ends: list

    def poses(self, motion):
        """Poses of the bodies from the motion (6N,) of a frame; shape (N, 6)"""
        from hakobune.mooring.motion.simulation.realisation import poses_of

        return poses_of(motion, self.at_rest)

    def threads(self, motion):
        """Points along the lines, m, with the bodies displaced by their motions (6N,); shape (lines × POINTS, 3)"""
        from hakobune.mooring.lines.system.equilibrium import held_at, rest
        from hakobune.mooring.lines.system.shapes import line_shapes

        poses = self.poses(motion)
        ropes = straight(*(self._carried(points, bodies, poses) for points, bodies in self.ends))
        if self.system is None:
            return ropes
        held = {name: tuple(map(float, pose)) for name, pose in zip(self.names, poses, strict=True)}
        return np.concatenate([*line_shapes(rest(held_at(self.system, held)), POINTS), ropes])

    def _carried(self, points, bodies, poses):
        out = np.array(points, float)
        for row, body in enumerate(bodies):
            if body >= 0:
                still = rotation(*self.at_rest[body, 3:])
                arm = still.T @ (out[row] - self.at_rest[body, :3])
                out[row] = poses[body, :3] + rotation(*poses[body, 3:]) @ arm
        return out


def scene_of_several(file):
    """`Scene` of an open file of runs.  Raises ValueError if its database no longer exists."""
    db, study = open_database(database_path(file)), make_study(tomllib.loads(file.attrs["study"]))
    hulls = study.hulls_of(db)
    berth, system = study.berth_of(db, hulls), study.system_of(db, hulls, in_time=True)
    at_rest = db.bodies_reader.axes_at_rest
    contacts, fenders, ropes = berth.arrays, len(berth.fenders), berth.ropes
    ends = [([one.fairlead for one in ropes], contacts.body[fenders:]),
            ([one.bollard for one in ropes], contacts.other[fenders:])]  # fmt: skip
    moored = Moored(list(hulls), at_rest, system, [(np.reshape(at, (-1, 3)), of) for at, of in ends])
    boxes = [_box(db, body, hulls) for body in db.bodies]
    still = np.array([[*body.rotation_center, 0.0, 0.0, body.heading] for body in db.bodies])
    span = float(np.ptp(np.concatenate([file["anchor"][:, :2], still[:, :2]]), axis=0).max())
    span += AROUND * max(one.box[1] - one.box[0] for one in boxes)
    moving = [number for number, body in enumerate(db.bodies) if not body.fixed]
    carriers = tuple(moving[other] if other >= 0 else -1 for other in contacts.other[:fenders])
    stage = Stage(tuple(boxes), span, float(file.attrs["water_depth"]), berth.fenders, carriers, still)
    held = system is not None or bool(ropes)
    return Scene(stage, partial(_placed, moored, still, moving), held, moored.threads)


def _placed(moored, still, moving, motion):
    """Poses of all bodies, also of those that are fixed, of motions (n, 6N); shape (n, bodies, 6)"""
    out = np.tile(still, (len(motion), 1, 1))
    out[:, moving] = [moored.poses(one) for one in motion]
    return out


def _box(db, body, hulls):
    """`Hull` of a body; a fixed one is drawn as high above the water as the highest of the others"""
    size = box_of(db, body)
    length, beam, draft = size["length"], size["beam"], size["draft"]
    top = hulls[body.name].freeboard if body.name in hulls else max(one.freeboard for one in hulls.values())
    return Hull((-length / 2, length / 2, -beam / 2, beam / 2, -draft, top), body.own_center)
