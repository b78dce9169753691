"""Fits of the memory and other arrays, kept from earlier runs in the folder of the compiled kernels.

A fit takes seconds, and all studies of a database need one fit.  The fit depends on arrays alone. The name of its
file is a digest of these arrays, of the source files and of the versions of numpy and scipy, so that a change of any
of them leads to a new fit.
"""

import hashlib
import io
from contextlib import suppress
from pathlib import Path
from zipfile import BadZipFile

import numpy as np
import scipy

from ..kernels.jit import ROOT, cache_folder
from ..kernels.sources import put_file
from .passive_fit import Passive

MOST = 256  # files, of some 20 to 200 kB; the oldest are deleted
UNREADABLE = OSError, ValueError, KeyError, EOFError, BadZipFile


class NoFit(Exception):
    """No system is within tolerance; best : the smallest error that was found"""

    def __init__(self, best):
        super().__init__(best)
        self.best = float(best)


def kept_fit(source, make, *arrays):
    """`Passive` from make(), or from an earlier call with equal arrays; source : source file of the code that makes
    the fit

    raises : NoFit if make() raises it or has raised it earlier; a search without result is kept too, because it takes
        as long as a fit
    """
    file = _file(source, arrays)
    found = _read(file)
    if found is None:
        try:
            found = make()
        except NoFit as fault:
            found = fault.best
        _put(file, {"best": found} if isinstance(found, float) else found._asdict())
    if isinstance(found, float):
        raise NoFit(found)
    return found


def kept_array(source, make, *arrays):
    """Array from make(), or from an earlier call with equal arrays; source : source file of the code that makes the
    array"""
    file = _file(source, arrays)
    with suppress(*UNREADABLE), np.load(file, allow_pickle=False) as stored:
        return stored["value"]
    value = make()
    _put(file, {"value": value})
    return value


def _read(file):
    """`Passive` of a file, or the smallest error of a search in vain; None without a whole file"""
    with suppress(*UNREADABLE), np.load(file, allow_pickle=False) as stored:
        if "best" in stored:
            return float(stored["best"])
        return Passive(*(stored[name] for name in Passive._fields))
    return None


def _put(file, arrays):
    data = io.BytesIO()
    np.savez(data, **arrays)
    with suppress(OSError):  # folder without write access, which the kernels also report
        put_file(file, data.getvalue())
        _drop_oldest(file.parent)


def _file(source, arrays):
    total = hashlib.sha256(f"{np.__version__} {scipy.__version__}".encode())
    for array in map(np.ascontiguousarray, arrays):
        total.update(f"{array.dtype.str}{array.shape}".encode())
        total.update(array.tobytes())
    return cache_folder(Path(source), ROOT) / "fits" / f"{total.hexdigest()[:32]}.npz"


def _drop_oldest(folder):
    files = sorted(folder.glob("*.npz"), key=lambda one: one.stat().st_mtime_ns)
    for file in files[:-MOST]:
        file.unlink(missing_ok=True)
