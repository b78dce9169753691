"""The output file of a result."""

from hakobune.meshing.seals import write_sealed

from ..common.outputs import DATABASE, check_output, opening
from .writing import schema

CSV = ".csv"
FORMS = (*DATABASE, CSV)
MARK = "# result of hakobune "


def check_result(path, kind, inputs=()):
    """Raise ValueError unless a result of a `kind` can be written to a path.

    inputs : paths of the study's input files, none of which is overwritten
    """
    check_output(path, f"a result of hakobune {kind}", lambda place: _is_one(place, kind), FORMS, inputs)


def write_result(result, path):
    """Write a result to a path that passed `check_result`: .h5, or .csv with a checksum in its header"""
    if path.suffix.lower() == CSV:
        told = "".join(f"# {line}\n" for line in (*result.told, *result.notes))
        write_sealed(path, f"{MARK}{result.kind}\n{told}{result.to_csv()}")
    else:
        result.write(path)


def finish(result, output=None, plot=None, draw=None):
    """Write, draw and print a result, then print the names of its files; returns the exit status

    output, plot : paths that were checked before, or None; draw : function of a result and a path
    """
    from .tables import printed

    if output is not None:
        write_result(result, output)
    if plot is not None:
        draw(result, plot)
    status = printed(result)
    for path in (path for path in (output, plot) if path is not None):
        print(path)
    return status


def _is_one(path, kind):
    if path.suffix.lower() == CSV:
        return opening(path)[0].startswith(f"{MARK}{kind}")
    from hakobune.bem.database.results import has_schema  # imported here, since it loads h5py

    return has_schema(path, schema(kind))
