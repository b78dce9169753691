"""One body from a database of several: the forces on this body, and its motions."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ..database.rows import Database, DatabaseError
from ..database.schema import BODY, QUANTITIES
from ..drift import OF_EACH
from ..modes import moving

OWN_DRIFT = {name.removeprefix("body_"): name for name in OF_EACH}  # {name of that of one body: of each of several}


@dataclass(frozen=True, eq=False)
class OneOfSeveral:
    """Rigid motions and forces of body `number` in a `Database` of several bodies, or of a flexible one.

    Forces, mean drift and added mass act on this body; motions and radiation are those of this body. Arrays have the
    axes of a database of one body; a fixed body has no motions.
    """

    database: Database
    number: int

    def __getattr__(self, name: str) -> Any:
        if name in BODY:
            value = self.database.header.body.get(name)
            if value is None or "influenced_dof" not in BODY[name][0]:
                return value[self.number] if value is not None and self.database.bodies else value
            return value[np.ix_(self._forces, self._motions)]
        return getattr(self.database, name)

    def __getitem__(self, name: str) -> np.ndarray:
        if OWN_DRIFT.get(name) in self.database.names:
            return self.database[OWN_DRIFT[name]][:, :, self.number]
        value = self.database[name]
        for place, axis in enumerate(QUANTITIES[name][0] if name in QUANTITIES else ()):
            own = {"influenced_dof": self._forces, "radiating_dof": self._motions}.get(axis)
            if own is not None:
                value = np.take(value, own, axis=place - len(QUANTITIES[name][0]))
        return value

    @property
    def name(self) -> str:
        """Name of the body"""
        return self.database.bodies[self.number].name if self.database.bodies else ""

    @property
    def fixed(self) -> bool:
        """Whether the body is fixed"""
        return bool(self.database.bodies) and self.database.bodies[self.number].fixed

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the quantities that are known for this body alone"""
        axes = {"influenced_dof"} if self.fixed else {"influenced_dof", "radiating_dof"}
        found = (name for name in self.database.names if axes & {*QUANTITIES[name][0]})
        own = [name for name in found if not (self.fixed and "radiating_dof" in QUANTITIES[name][0])]
        return (*own, *(name for name, of_each in OWN_DRIFT.items() if of_each in self.database.names))

    @cached_property
    def mesh(self):
        """PanelMesh of the hull of this body"""
        database = self.database
        if not database.bodies:
            return database.mesh
        return replace(database.mesh.of_body(self.number), name=f"{self.name} of {database.path.stem}")

    @property
    def reader(self):
        """None: the motions of one body depend on the motions of all bodies"""
        return None

    @property
    def _forces(self):
        return list(range(6 * self.number, 6 * self.number + 6))

    @property
    def _motions(self):
        own = moving(self.database.bodies)  # without shapes, which follow all of these
        return [own.index(d) for d in self._forces if d in own]


def each_body(database):
    """`OneOfSeveral` of every body, rigid or flexible; for a database of one rigid body the database itself"""
    count = len(database.bodies) or bool(database.modes)
    return [OneOfSeveral(database, i) for i in range(count)] or [database]


def body_named(database, name):
    """`OneOfSeveral` of the named body.  Raises DatabaseError for an unknown name."""
    found = [one for one in each_body(database) if database.bodies and one.name == name]
    if not found:
        known = ", ".join(body.name for body in database.bodies) or "one body without a name"
        raise DatabaseError(f"{database.path} has no body {name!r}; allowed: {known}")
    return found[0]
