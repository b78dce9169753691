"""Whether the file of a simulation is unchanged, row by row."""

import numpy as np

from hakobune.bem.database.integrity import DatabaseError, VersionError
from hakobune.mooring.criteria.failing import fails

from .file import opened, summary_is_whole, whole_rows


def check_run(path, say):
    """Print which seeds are stored, missing and damaged; returns 0 if all are whole, else 1.

    raises : `VersionError` for a file of another version, whose contents are unknown
    """
    try:
        with opened(path) as file:
            whole, marked, seeds = whole_rows(file), file["stored"][()] != 0, file["seed"][()]
            summed = summary_is_whole(file) or not whole.any()
    except VersionError:
        raise
    except DatabaseError as error:
        say(fails(str(error)))
        return 1
    say(f"{path}: {whole.sum()} of {len(seeds)} seeds are stored and unchanged, by their checksums")
    for chosen, text in ((marked & ~whole, "damaged"), (~marked, "missing")):
        if chosen.any():
            named = ", ".join(map(str, seeds[chosen][:10])) + (" …" if np.count_nonzero(chosen) > 10 else "")
            say(fails(f"{text}: seeds {named}; run the command that made the file to compute them again"))
    if not summed:
        say(fails("damaged: the statistics over all seeds; run the command that made the file to compute them again"))
    return 0 if whole.all() and summed else 1
