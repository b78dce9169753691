"""Missing parts of a database: unsolved frequencies and unknown numbers, in one line each."""

from typing import NamedTuple

import numpy as np

from hakobune.bem.database.schema import QUANTITIES


class Gaps(NamedTuple):
    """asked : all requested frequencies, (n,) rad/s; solved : (n,), whether each is solved; path : path of the file

    unknown : {quantity: {name of a motion, or "": (m,) indices, among solved frequencies, without a value}}
    """

    path: object
    asked: np.ndarray
    solved: np.ndarray
    unknown: dict

    @property
    def spans(self):
        """[(low, high) rad/s], ranges with unsolved frequencies, between solved frequencies or the ends of the whole
        range
        """
        out, w, whole = [], self.asked, self.solved
        for i in np.flatnonzero(~whole):
            before, after = np.flatnonzero(whole[:i]), np.flatnonzero(whole[i:])
            span = (w[before[-1]] if len(before) else w[0], w[i + after[0]] if len(after) else w[-1])
            out += [] if span in out else [span]
        return out

    def words(self):
        """Lines for a reader"""
        yield from self.not_solved()
        yield from self.not_known()

    def not_solved(self):
        """The message on unsolved frequencies, if there are any"""
        w, count = self.asked[~self.solved], int(np.sum(~self.solved))
        if count:
            where = f"{w[0]:.4g} rad/s" if count == 1 else f"{w[0]:.4g} to {w[-1]:.4g} rad/s"
            yield (
                f"{self.path}: {count} of {len(self.asked)} frequencies are not solved, {where}; 'hakobune solve SCENE "
                f"--output {self.path}', or the command that made it, solves them"
            )

    def not_known(self):
        """Messages on quantities without values at solved frequencies"""
        solved = self.asked[self.solved]
        for name, motions in self.unknown.items():
            places = np.unique(np.concatenate(list(motions.values())))
            named = ", ".join(one.lower() for one in motions if one)
            of = f" of {named}" if named else ""
            at = "at all frequencies"
            if len(places) < len(solved):
                low, high = solved[places[[0, -1]]]
                span = f"{low:.4g} rad/s" if len(places) == 1 else f"{low:.4g} to {high:.4g} rad/s"
                at = f"at {len(places)} of {len(solved)} frequencies, {span}"
            yield (
                f"{self.path}: {name}{of} is not a number {at}; solve it again with --fresh, by a method that "
                f"computes it"
            )


def gaps_of(db):
    """`Gaps` of an opened database"""
    names = [name for name in db.names if QUANTITIES[name][0][0] == "omega"] if db.rows.any() else []
    found = {name: _unknown(db, name) for name in names}
    return Gaps(db.path, db.asked, db.rows, {name: motions for name, motions in found.items() if motions})


def _unknown(db, name):
    wrong, axis = ~np.isfinite(db[name]), QUANTITIES[name][0][-1]
    if not wrong.any():
        return {}
    labels = list(db[axis]) if axis.endswith("dof") else [""]
    if labels == [""]:
        wrong = wrong.any(axis=-1)[..., None]
    at = wrong.reshape(len(wrong), -1, len(labels)).any(axis=1)
    return {str(label): np.flatnonzero(at[:, j]) for j, label in enumerate(labels) if at[:, j].any()}
