"""One case of a sweep: a call of its study function, and the requested quantities of its result."""

import inspect
import tempfile
from importlib import import_module
from pathlib import Path

from ..results.result import Result
from ..results.studies import function_of
from .file import SIZE
from .solved import solved
from .study import SOLVE, StudyError

INTERRUPTED = 130  # exit status of a command that Ctrl-C ended
DRAWS = ("output", "plot")  # flags of commands that write files, which a sweep does not use


def given_to(command, arguments):
    """{name: value} of the arguments after the study, for its function.  Raises StudyError."""
    if command == SOLVE:
        return {}
    app = import_module("hakobune.pipelines.cli").app
    words = [command, "study.toml", *arguments]
    if "output" in _needed(app, command) and "--output" not in arguments:
        words += ["--output", "none.h5"]  # file name for a command that always writes a file
    _, bound, _ = app.parse_args(words, exit_on_error=False, print_error=False)
    study = next(iter(bound.arguments))  # what the command calls it: study, system, file …
    taken = inspect.signature(function_of(command)).parameters
    given = {name: value for name, value in bound.arguments.items() if name != study}
    wrong = [name for name in given if name not in taken or (name in DRAWS and f"--{name}" in arguments)]
    if wrong:
        raise StudyError(
            f"arguments contain --{wrong[0]}; allowed in a sweep: the flags of hakobune.{command} that do not name a "
            f"file"
        )
    return {name: value for name, value in given.items() if name not in DRAWS}


def _needed(app, command):
    """Names of the required arguments of a command"""
    parameters = inspect.signature(app[command].default_command).parameters.values()
    return [one.name for one in parameters if one.default is one.empty]


def one_case(command, raw, study, given, keep):
    """Return (exit status, what fails, {name: Quantity}, {axis: labels}) of a study; its tables are written to a
    temporary file beside the study.

    given : from `given_to`; keep : names of quantities, () for all short quantities. A failed case may lack some;
        its message names them
    """
    if command == SOLVE:
        status, message, quantities, axes = solved(raw, Path(study))
        if status == INTERRUPTED:
            raise KeyboardInterrupt
    else:
        try:
            result = _called(command, raw, Path(study), given)
        except ValueError as error:
            return 2, " ".join(str(error).split()), {}, {}
        status, message, quantities, axes = result.status, "; ".join(result.fails), result, result.labels
    absent = [name for name in keep if status and not _has(quantities, name)]
    if not absent:
        return status, message, kept(quantities, keep), axes
    there = [name for name in keep if name not in absent]
    message = "; ".join(filter(None, (message, f"the result has no quantity {', '.join(absent)}")))
    return status, message, kept(quantities, there) if there else {}, axes


def _has(quantities, name):
    if not isinstance(quantities, Result):
        return name in quantities
    try:
        quantities.quantity(name)
    except KeyError:
        return False
    return True


def _called(command, raw, study, given):
    import tomli_w

    with tempfile.NamedTemporaryFile("wb", suffix=".toml", prefix=".case_", dir=study.parent) as place:
        place.write(tomli_w.dumps(raw).encode())
        place.flush()
        return function_of(command)(place.name, **given)


def kept(quantities, keep):
    """{name: Quantity} of the requested quantities.  Raises StudyError for an unknown name."""
    if isinstance(quantities, Result):
        if keep:
            try:
                return {name.replace("[*]", ""): quantities.quantity(name) for name in keep}
            except KeyError as error:
                raise StudyError(f"keep: {error.args[0]}") from None
        quantities = quantities.quantities
    elif keep:
        missing = [name for name in keep if name not in quantities]
        if missing:
            raise StudyError(f"keep: {missing[0]!r} is not a quantity of the result; allowed: {', '.join(quantities)}")
        return {name: quantities[name] for name in keep}
    else:
        return quantities
    return {name: one for name, one in quantities.items() if not one.record and one.values.size <= SIZE}
