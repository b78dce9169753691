"""What is asked of a frequency, to be compared."""

from __future__ import annotations

import numpy as np


def question_key(question):
    """Equal for equal questions: headings, want, theta and dofs of a run"""
    headings, want, theta, dofs = question
    parts = (np.asarray(part, float).tobytes() if part is not None else None for part in (headings, theta))
    return (*parts, frozenset(want), tuple(dofs))
