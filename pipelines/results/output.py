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


def finish(result, *files):
    """Write the files of a result and print it, then print their names; returns the exit status

    files : (path, function of the result and the path), with paths that were checked before; None for a file that is
        not wanted
    """
    from .tables import printed

    files = [(path, write) for path, write in files if path is not None]
    for path, write in files:
        write(result, path)
    status = printed(result)
    for path, _ in files:
        print(path)
    return status


def _is_one(path, kind):
    if path.suffix.lower() == CSV:
        return opening(path)[0].startswith(f"{MARK}{kind}")
    from hakobune.bem.database.results import has_schema  # imported here, since it loads h5py

    return has_schema(path, schema(kind))
