"""What a process of its own does, without the second that it takes to begin one: a fork of this one."""

import os
import sys
import traceback
from threading import Thread
from typing import NamedTuple


class Done(NamedTuple):
    status: int
    stdout: str
    stderr: str


def ended(work):
    """`Done` of work(), whose value is the status, None for 0; SystemExit and what is raised end it as ever"""
    ends = [os.pipe(), os.pipe()]
    sys.stdout.flush(), sys.stderr.flush()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            for number, (_, end) in enumerate(ends, 1):
                os.dup2(end, number)
            sys.stdout, sys.stderr = os.fdopen(1, "w"), os.fdopen(2, "w")
            sys.dont_write_bytecode = True  # of files that tests change or that a limit cuts short
            status = work() or 0
        except SystemExit as done:
            status = done.code or 0
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stdout.flush(), sys.stderr.flush()
            os._exit(status)
    for _, end in ends:
        os.close(end)
    told = ["", ""]

    def read(i):
        with os.fdopen(ends[i][0]) as file:
            told[i] = file.read()

    second = Thread(target=read, args=(1,))
    second.start()
    read(0)
    second.join()
    return Done(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), *told)
