"""The exit status of a command, and the lines with its reason.

    0    done, without failures
    1    done, and something breaks, or fails a limit, check or tolerance: each with a line that begins with FAILS
    2    refused or not done, with one line that gives the reason
    130  interrupted
    141  the reader of the output has closed

docs/commands.md lists the failures of each command.
"""

from hakobune.mooring.criteria.failing import FAILS, failing


def tell(findings, console=None, remark="warning: "):
    """Print findings, failures last; returns the exit status: 1 if there is a failure, else 0

    findings : lines, including those of `mooring.criteria.failing.fails`; remark : prefix of the others
    """
    from .console import new_console

    console, lines = console or new_console(), list(dict.fromkeys(findings))
    failed = failing(lines)
    for text in (line for line in lines if not line.startswith(FAILS)):
        console.print(f"{remark}{text}", style="yellow", highlight=False, soft_wrap=True, markup=False)
    for text in failed:
        console.print(text, style="red", highlight=False, soft_wrap=True, markup=False)
    return status_of(failed)


def status_of(findings):
    """Exit status of a command with the given findings: 1 if any finding fails, else 0"""
    return int(bool(failing(findings)))
