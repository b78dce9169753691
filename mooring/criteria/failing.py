"""What breaks, or fails what was asked: a line of text that says so, wherever it is kept or printed.

A finding is a line.  One that begins with FAILS tells of something that breaks, or that is beyond a limit, check or
tolerance that the user or a default of the rule asked for; it has the thing, the number, the limit, the way out.  Any
other is a remark.  The mark is part of the text, so that files, pages and other processes keep it.
"""

from __future__ import annotations

FAILS = "FAILS: "


def fails(text):
    """The line that says of `text` that it fails"""
    return text if text.startswith(FAILS) else FAILS + text


def failing(findings):
    """Those lines of `findings` that fail, in order, each once"""
    return [line for line in dict.fromkeys(findings) if line.startswith(FAILS)]
