"""Where the links of a fallen chain have to be short: on either side of places where its contacts change.

A contact is read to a link's length.  A chain at rest is divided anew, into links of a given size where it begins to
lie, to hang, to be slack or to turn round, where it passes a vertex, and at its loads; they grow from there to those
of the chain that fell first, and it falls again, which takes few steps.  Over a sharp ridge a polygon does not slide
without friction: a link that passes it is a step in E, of T times a part of the link, unless several links lie on its
rounding; so short links come with a rounding of several of them, and where the chain has slid along, again.
"""

from __future__ import annotations

import numpy as np

EVEN = 20  # links of the same length on either side of such a place
GROWTH = 1.4  # of one link to the next farther off


def changes(chain):
    """(n,) whether the contacts of a chain change at its nodes"""
    touches, slack, way = chain.N > 0, chain.T <= 1e-9, np.diff(chain.u[:, 0]) > 0
    changed, mark = touches[1:] != touches[:-1], np.zeros(len(touches), bool)
    near = touches.copy()
    near[1:] |= touches[:-1]
    near[:-1] |= touches[1:]
    for x in chain.x[1:-1]:
        changed |= ((chain.u[:-1, 0] - x) * (chain.u[1:, 0] - x) <= 0) & (near[:-1] | near[1:])
    mark[1:] |= changed
    mark[:-1] |= changed
    mark[1:-1] |= (slack[1:] != slack[:-1]) | (way[1:] != way[:-1])
    mark[chain.loads] = True
    return mark


def divided(chain, size):
    """s (m,) of nodes, rising, `size` apart where the contacts of a FallingChain change; both of its length"""
    close = chain.s[changes(chain)]
    out = [0.0]
    while out[-1] < 2 / len(chain.s):
        out.append(out[-1] + size * GROWTH ** max(len(out) - EVEN + 1, 0))
    places = np.concatenate([chain.marks, chain.s, np.linspace(0.0, 1.0, chain.links), *(close[:, None] + out)])
    places = np.unique(np.concatenate([places, *(close[:, None] - out)]))
    places = places[(places >= 0) & (places <= 1)]
    away = np.abs(places[:, None] - close).min(axis=1, initial=1.0)
    least = np.clip(0.15 * (away - EVEN * size), 0.6 * size, 0.6 / chain.links)
    return _kept(places, least, np.isin(places, chain.marks))


def _kept(places, least, marks):
    """Places, rising, without those nearer than `least` to one before; joints, loads and ends stay"""
    kept = [0]
    for k in range(1, len(places)):
        if marks[k] and not marks[kept[-1]] and places[k] - places[kept[-1]] < least[k]:
            kept[-1] = k
        elif marks[k] or places[k] - places[kept[-1]] >= least[k]:
            kept.append(k)
    return places[kept]
