"""The states of a line, numbered alike for solutions and kernels."""

from enum import IntEnum


class State(IntEnum):
    """State of a line: it hangs vertically with H = 0, lies partly on the bed, or touches nothing.

    A line without forces is too short for its ends, has an end below the bed, or its equilibrium was not found.
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
