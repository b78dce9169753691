"""Time and memory of forces of wave pairs, reported before they are solved. Times of first-order waves follow from
measured rows of their matrices, memory from counting the stored flow.
"""

import math

import numpy as np

from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.panels.band.cost import memory_alone, seconds_alone
from hakobune.bem.second_order.quadratic_forces import frequencies_of

from ..common.bounds import MUCH, check_memory, told

LEAST_NODES = 400  # of a mesh whose rows are timed: with fewer a run takes less than a minute
WORTH_SAYING = 60.0  # s
BYTES_OF_FLOW = 1300.0  # kept for each wave and panel of the whole hull (`question.MOST_WAVES`)
WAY_OUT = "give fewer frequencies (--omega) or headings (--heading), or fewer panels"


def foretell(problems, question):
    """Report the time and memory of the first-order waves of a `Question` on each of `problems`.

    Only waves that take more than a minute or a gigabyte are reported, and only problems on panels.

    raises : TooMuchError for more memory than is free
    """
    problems = [one for one in problems if isinstance(one, PanelProblem)]
    if not problems:
        return
    of_force = frequencies_of(question.omega, question.highest, question.kind)
    count = len(question.omega) + int(np.sum(~_among(of_force, question.omega) & (of_force > 0)))
    waves = len(question.omega) * len(question.headings)
    seconds, memory, flows, sizes = 0.0, 0.0, 0.0, []
    for problem in problems:
        prepared = problem.prepared()
        if len(prepared.geometry.elements.nodes) < LEAST_NODES:
            continue
        one = seconds_alone(prepared, float(max(question.omega[-1], of_force[-1])))
        seconds += 0.0 if math.isnan(one) else count * one
        memory = max(memory, memory_alone(prepared))
        flows += BYTES_OF_FLOW * waves * problem.mesh.total
        sizes.append(f"{problem.mesh.total}")
    if seconds < WORTH_SAYING and memory + flows < MUCH:
        return
    what = f"first-order waves at {count} frequencies on {' and '.join(sizes)} panels"
    check_memory(f"{what} need", memory + flows, WAY_OUT)
    told(f"{what}, before the pairs of {waves} waves: at most", seconds, memory=memory + flows)


def _among(values, known):
    """Whether each of `values` (d,) is one of `known` (n,), at even steps; shape (d,)"""
    return np.abs(values[:, None] - known).min(axis=1, initial=np.inf) <= 1e-6 * known.max()
