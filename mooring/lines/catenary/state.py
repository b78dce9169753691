"""The states of a line, numbered alike for solutions and kernels."""

from enum import IntEnum


class State(IntEnum):
    """A line hangs vertically with H = 0, lies partly on the bed, touches nothing; or it has no forces: too short for
    its ends, an end below the bed, or no equilibrium found.
    """

    SLACK = 0
    GROUNDED = 1
    SUSPENDED = 2
    BEYOND_REACH = 3
    BELOW_BED = 4
    UNSOLVED = 5


SLACK, GROUNDED, SUSPENDED, BEYOND_REACH, BELOW_BED, UNSOLVED = map(int, State)  # whole numbers for kernels
HEAP = 1e-300  # λ of a piece in a heap, which has no extent


class LineError(ValueError):
    """A line without equilibrium, or whose equilibrium was not found."""


class BeyondReachError(LineError):
    """A line that is too short for its ends."""
