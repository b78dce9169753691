"""A campaign from its first scene to its last: rows are written, and failures and time left printed, as they come."""

from __future__ import annotations

import time

from hakobune.meshing.seals import write_sealed

from ...common.bounds import told
from ...common.interrupt import ctrl_c
from ...common.outputs import check_output
from ...common.progress import duration
from ...executors.choice import Here
from .campaign import row_of
from .table import Writer, is_table, summary

SECONDS = 0.5  # of a scene, about
EVERY = 5.0  # s between lines of progress
AHEAD = 200  # scenes that processes are given before the first is back: one of many waves takes as long as a hundred


def run(questions, output, executor, say):
    """(rows, whether Ctrl-C ended it) of questions, the arguments of `row_of`; rows go into the CSV `output`

    say : takes each line of progress
    """
    check_output(output, "a table of stress scenes", is_table, (".csv",))
    told(f"{len(questions)} scenes take", SECONDS * len(questions) / executor.count)
    rows, printed = [], time.perf_counter()
    start = printed
    with output.open("w", newline="", encoding="utf-8") as file, ctrl_c(say) as stop:
        writer = Writer(file, ["seed {0}, method {2}, tolerance {3:g}, at most {4:g} waves".format(*questions[0])])
        for row in _answers(questions, executor):
            rows.append(row)
            writer.write(row)
            if row.verdict:
                say(f"scene {row.number}: {row.verdict}\n  {row.command}")
            now = time.perf_counter()
            if now - printed > EVERY:
                printed, left = now, (now - start) / len(rows) * (len(questions) - len(rows))
                failed = sum(1 for row in rows if row.verdict)
                say(f"{len(rows)}/{len(questions)}  {failed} failed  {duration(left)} left")
            if stop.asked:
                break
    write_sealed(output, output.read_text(encoding="utf-8"))
    for line in summary(rows):
        say(line)
    return rows, len(rows) < len(questions)


def _answers(questions, executor):
    """Rows in the order of the questions"""
    if isinstance(executor, Here):
        yield from (row_of(*question) for question in questions)
        return
    waiting = []
    for question in questions:
        waiting.append(executor.submit(row_of, *question))
        if len(waiting) >= AHEAD:
            yield waiting.pop(0).result()
    yield from (future.result() for future in waiting)
