"""Cost of a study of responses: memory and seconds, from its points, directions and sea states."""

from ..common.bounds import check_memory, check_seconds, told

RESPONSES = 18, 13  # responses of a body, and of a point
BYTES = 500 * 16.0 * 5  # bytes of a response at one heading: 500 frequencies, with results (3.7 to 5.8)
HEADINGS = 36  # headings of short-crested waves
BYTES_OF_STATE = 60.0  # bytes of a response in a sea state
SECONDS_OF_POINT = 0.04  # s, time of a point with its rows of the table
SECONDS_OF_SEA, SECONDS_OF_STATE = 1.5e-4, 3e-7  # s of a response in a sea, and in a state; measured
WAY_OUT = "give fewer points, directions or classes"


def check_effort(read, scatter=None):
    """Raise TooMuchError for a ResponseStudy that does not fit in memory, and announce the time of a long one.

    scatter : `mooring.environment.scatter.Scatter` of a climate
    """
    responses = RESPONSES[0] + RESPONSES[1] * len(read.points)
    table = read.sea or read.climate
    directions = 1 if read.sea else len(read.climate.directions)
    headings = directions * (1 if table.spreading is None else HEADINGS)
    memory, seconds = BYTES * responses * min(headings, 360), SECONDS_OF_POINT * len(read.points)
    what = f"{responses} responses"
    if scatter is not None:
        states = directions * int((scatter.probability > 0).sum())
        seas = directions * int(scatter.probability.any(axis=0).sum())
        memory += BYTES_OF_STATE * responses * states
        seconds += responses * (SECONDS_OF_SEA * seas + SECONDS_OF_STATE * states)
        what += f" in {states} sea states"
    check_memory(f"{what} need", memory, WAY_OUT)
    check_seconds(f"{what} take", seconds, WAY_OUT)
    told(f"{what} take", seconds, memory=memory)
