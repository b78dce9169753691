"""A line of text about something that breaks, or fails a limit, wherever the line is kept or printed.

A finding is one line.  A finding that begins with FAILS reports something that breaks, or that exceeds a limit, check
or tolerance set by the user or by default. It names the thing, the number, the limit and a remedy.  Any other is a
remark.  The mark is part of the text, so files, pages and other processes keep it.
"""

FAILS = "FAILS: "


def fails(text):
    """The finding that `text` reports a failure"""
    return text if text.startswith(FAILS) else FAILS + text


def failing(findings):
    """The failures among `findings`, in order, each once"""
    return [line for line in dict.fromkeys(findings) if line.startswith(FAILS)]
