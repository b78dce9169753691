"""Spectra of buoys, hindcasts and wave models, in one and in two dimensions.

    SWAN (`swan`);  NDBC, Datawell, TRDI, Triaxys, Spotter (`buoys`);  WAVEWATCH III's transfer file (`wavewatch`).
    netCDF files of WAVEWATCH III, ERA5, SWAN, WWM, NDBC, Sofar and wavespectra (`netcdf`). A table of densities (.csv)

Nautical directions N are those that waves come from, clockwise from north. If the body's x axis points to the
compass heading ψ, waves travel towards β = ψ − (N + 180°).  Cartesian directions are those in which waves travel,
from the x axis of the model. The model's x axis, turned by the given heading, is taken as the x axis of the body.
"""

from pathlib import Path

from hakobune.meshing.text_files import read_text

from ..environment.sea import Sea
from ..environment.spectra import read_spectrum
from ..environment.tables import TableError
from . import buoys
from .planes import TabulatedSpreading, two_dimensional
from .swan import Swan
from .wavewatch import HEAD, read_wavewatch

__all__ = ["TabulatedSpreading", "read_sea", "two_dimensional"]

NETCDF = (b"CDF", b"\x89HDF")


def read_sea(path, x_axis=None, time=None, location=1):
    """`environment.sea.Sea` of a file of the module; long-crested towards 0 if the file has no directions.

    x_axis : compass heading of the x axis, degrees, needed for nautical directions of planes; without it, buoy
        spectra are long-crested
    time : time as in the file, or the beginning of its text; by default the only time
    location : number of the place in the file. Raises TableError that names the line.
    """
    path = Path(path)
    if path.is_file() and _begin(path).startswith(NETCDF):
        from .netcdf import read_netcdf

        return read_netcdf(path, x_axis, time, location)
    text = read_text(path, TableError)
    if text.lstrip().upper().startswith("SWAN"):
        return Swan(path, text).sea(x_axis, time, location)
    if reader := buoys.kind(text):
        return reader(path, text, x_axis, time)
    if path.suffix.lower() == ".csv":
        return Sea(read_spectrum(path))
    if text.lstrip().startswith(HEAD):
        found = read_wavewatch(path, text, x_axis, time, location)
        try:
            return two_dimensional(*found, path.stem)
        except ValueError as error:
            raise TableError(f"{path}: {error}") from None
    raise TableError(
        f"{path} is not a spectrum of SWAN, NDBC or WAVEWATCH III, Datawell (.spt), TRDI, Triaxys or Spotter (.csv), "
        f"or netCDF; allowed: a first line SWAN, #YY MM DD hh mm .0200 …, or {HEAD}; the package wavespectra "
        "converts others: read_…(file).spec.to_swan(…)"
    )


def _begin(path):
    with path.open("rb") as file:
        return file.read(4)
