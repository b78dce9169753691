"""The cases of a sweep, run by any executor, stored as they finish."""

import contextlib
import time
import tomllib
from pathlib import Path
from typing import NamedTuple

from hakobune.bem.database.file import unlocked
from hakobune.bem.database.results import check_version

from ..results.given import database_of
from . import file
from .one_case import given_to, one_case
from .study import StudyError, cases, check_keys, varied


class Outcome(NamedTuple):
    """cases : all cases of the sweep; failed : [(number, status, message)] of the cases with a status above 0

    lost : (number of cases not done because their worker was lost, reason of one of them)
    """

    cases: int
    failed: list
    lost: tuple[int, str]


def sweep(table, text, folder, output, executor, say, fresh=False):
    """Run the pending cases.  Returns an Outcome.  Raises StudyError before any work.

    table, text : from `read_sweep`; folder : folder of the sweep's file; executor : with submit; say : called with
    each line
    fresh : replace an existing file
    """
    study = Path(folder) / table.study
    if not study.is_file():
        raise StudyError(f"study is {table.study!r}, but there is no such file in the folder of the sweep")
    study_text = study.read_text(encoding="utf-8")
    raw, keys, values = tomllib.loads(study_text), [one.key for one in table.vary], cases(table)
    check_keys(table.command, varied(raw, keys, values[0]))
    given = given_to(table.command, table.arguments)
    if given.get("database") is not None:
        database_of(given["database"])  # every case would open it
    texts = {"sweep": text, "study": study_text}
    if output.exists() and not fresh:
        _check_same(output, texts)
    else:
        file.create(output, keys, values, texts)
    todo, done, lost = file.pending(output), 0, []
    say(f"{len(values)} cases, {len(values) - len(todo)} of them stored already")
    together = 1 if executor.count == 1 else BATCH * executor.count
    with _kept_together(output) as keep:
        for batch in (todo[i : i + together] for i in range(0, len(todo), together)):
            asked = {}
            for number in batch:
                case = varied(raw, keys, values[number])
                asked[number] = executor.submit(one_case, table.command, case, str(study), given, tuple(table.keep))
            for number, future in asked.items():
                try:
                    result = future.result()
                except StudyError:
                    raise
                except Exception as error:  # its worker was lost; a refusal by a command is a result
                    lost.append(f"case {number}: {' '.join(str(error).split()) or type(error).__name__}")
                    continue
                keep((number, *result))
                done += 1
            say(f"{len(values) - len(todo) + done} of {len(values)} cases")
    return Outcome(len(values), _failed(output), (len(lost), lost[0] if lost else ""))


BATCH = 8  # cases given to each process at once, which are lost with it
BLOCK = 0.5  # s, whose cases a kill can lose; opening the file for each would take as long as writing it


@contextlib.contextmanager
def _kept_together(output):
    """A function that receives the result of a case; results are stored every `BLOCK` s, and at the end in any case"""
    waiting, since = [], time.monotonic()

    def write():
        if waiting:
            file.store(output, waiting)
            waiting.clear()

    def keep(result):
        nonlocal since
        waiting.append(result)
        if time.monotonic() - since >= BLOCK:
            write()
            since = time.monotonic()

    try:
        yield keep
    finally:
        write()


def _check_same(output, texts):
    with unlocked(output) as stored:
        check_version(output, file.SCHEMA, str(stored.attrs["schema"]))
        for name, text in texts.items():
            if stored.attrs[name] != text:
                raise StudyError(f"{output} belongs to another {name}; give --fresh to replace it, or another name")


def _failed(output):
    with unlocked(output) as stored:
        status, message = stored["status"][()], stored["message"].asstr()[()]
    return [(int(i), int(status[i]), message[i]) for i in range(len(status)) if status[i] > 0]
