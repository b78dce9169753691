"""States that represent all hours: maximum dissimilarity (Camus et al. 2011, Coastal Engineering 58, 453-462).

    next = argmax over hours of min over chosen states of ‖x − x_s‖

in features scaled to 0 … 1; a direction is a point on a circle of diameter 1.  The first state is the highest sea.
The first states lie at the edges of the cloud of hours; later states fill its interior ever more densely.
"""

import numpy as np


def features(numbers, directions=()):
    """Features of hours, shape (n, d): numbers [(n,), …] scaled by their ranges, directions [(n,) rad, …] as points
    on a circle
    """
    columns = []
    for values in numbers:
        least, width = np.min(values), np.ptp(values)
        columns.append((values - least) / width if width > 0 else np.zeros_like(values))
    for angle in directions:
        columns += [0.5 * np.cos(angle), 0.5 * np.sin(angle)]
    return np.stack(columns, axis=1)


def most_dissimilar(x, count, first):
    """Indices (count,) of rows of x (n, d), fewer if no further rows differ; first : the first index"""
    chosen = [int(first)]
    nearest = np.sum((x - x[first]) ** 2, axis=1)
    while len(chosen) < count:
        further = int(np.argmax(nearest))
        if not nearest[further] > 0:
            break
        chosen.append(further)
        nearest = np.minimum(nearest, np.sum((x - x[further]) ** 2, axis=1))
    return np.array(chosen)
