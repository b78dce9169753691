"""The mark of a finding on something that breaks or fails a limit, wherever the finding is kept or printed.

A finding is one line. A finding that begins with FAILS reports something that breaks, or that exceeds a limit, check
or tolerance set by the user or by default. Such a finding names the thing, the number, the limit and a remedy. Any
other finding is a remark.  The mark is part of the text, so files, pages and other processes keep it.
"""

FAILS = "FAILS: "


def fails(text):
    """The finding, marked as a failure, with this text"""
    return text if text.startswith(FAILS) else FAILS + text


def failing(findings):
    """The failures among `findings`, in their order and without repetition"""
    return [line for line in dict.fromkeys(findings) if line.startswith(FAILS)]
