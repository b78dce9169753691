"""A moored body in time: `moored` prepares the parts that are independent of the weather; `simulate` runs one seed."""

from .failures import Overload, SimulationError
from .loads import wave_components
from .moored_body import Moored, moored, with_memory
from .realisation import Realisation
from .run import simulate, with_lines_chosen
from .trial import Choice, able_to_move

__all__ = [
    "Choice",
    "Moored",
    "Overload",
    "Realisation",
    "SimulationError",
    "able_to_move",
    "moored",
    "simulate",
    "wave_components",
    "with_lines_chosen",
    "with_memory",
]
