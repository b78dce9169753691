"""Statistics over all runs of a simulation: the largest value, its utilisation, the number of runs, the uncertainty."""

import json
import tomllib

import numpy as np

from hakobune.mooring.criteria.anchors import LIFTED, anchor_findings, stored_anchor
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.criteria.overuse import HELP, OF_STUDY
from hakobune.mooring.motion.extremes import CONFIDENCE, FEWEST, RARE, beyond, rare, share_beyond
from hakobune.mooring.response.findings import LINES_NAMED, some

from ..common.units import KN
from ..moor.study import make_study
from ..printing.number import significant
from .beside import differ as differ_by
from .file import STATISTICS, ropes_of, told, whole_rows

OF_LINES = "left out: inertia and drag"  # start of the finding of `mooring.motion.simulation.trial` on static lines
MOVE = (
    "run the lines in motion first (dynamic_lines): snaps of static lines do not justify a larger size or more "
    "pretension"
)
SOFTER = "give longer or softer ropes, as by tails, or more ropes; a stronger rope of the same break_strain is stiffer"


def largest_in_runs(file, kind):
    """Largest value in each run of the quantities of a kind, as "tension", shape (runs, q), and the names of their
    parts, (q,)"""
    names = [name.partition(" ") for name in file["quantity"].asstr()[()]]
    chosen = [i for i, (word, _, _) in enumerate(names) if word == kind]
    rows = file["statistics"][()][whole_rows(file)]
    return rows[:, chosen, STATISTICS.index("largest")], [names[i][2] for i in chosen]


def used_in_runs(file):
    """Largest utilisation of the breaking load in each run, nan if unknown; shape (runs, lines)"""
    return file["used"][()][whole_rows(file)]


def overloads(file, allowable=None):
    """Failures of lines and ropes: lines and ropes that part or exceed the allowable tension in any run, and in how
    many runs

    allowable : share of the breaking load instead of the study's, 1 if the utilisation is judged elsewhere
    """
    used, allowable = used_in_runs(file), float(file.attrs["allowable"] if allowable is None else allowable)
    names, most = file["line"].asstr()[()], used.max(axis=0)
    allowed = f"above the allowable {100 * allowable:g} % of the breaking load"
    for chosen, limit, text in (
        (most > 1, 1.0, "beyond the breaking load, limit 100 %, at which they break"),
        ((most > allowable) & (most <= 1), allowable, allowed),
    ):
        counts, order = beyond(used, limit), [i for i in np.argsort(-most, kind="stable") if chosen[i]]
        named = [f"{names[i]} {100 * most[i]:.4g} % in {counts[i]} of {len(used)} runs" for i in order]
        if named:
            more = " more" if limit < 1 and (most > 1).any() else ""
            way = SOFTER if names[order[0]] in ropes_of(file) else _way_out(file, HELP)
            share = f"{len(named)}{more} of {len(names)}"
            whose = OF_STUDY if limit < 1 else ""
            yield fails(f"{share} lines in the runs {text}: {some(named, LINES_NAMED)}; {way}{whose}")


def most_loaded(file):
    """The line or rope with the largest share of its breaking load in all runs, as a note; nothing without lines"""
    largest, _ = largest_in_runs(file, "tension")
    if not largest.size:
        return
    used, most = used_in_runs(file).max(axis=0), largest.max(axis=0)
    known = np.isfinite(used).any()
    worst = int(np.nanargmax(used) if known else np.argmax(most))
    share = (
        f"{100 * used[worst]:.0f} % of its breaking load (allowable {100 * float(file.attrs['allowable']):g} %)"
        if known
        else "its utilisation is unknown, since no breaking load is given"
    )
    name = file["line"].asstr()[()][worst]
    weakest = json.loads(file.attrs.get("weakest_segments", "{}")).get(name) if known else None
    part = f", that of its weakest segment, {weakest[0]}, {significant(weakest[1] / KN)} kN" if weakest else ""
    yield f"largest tension: {significant(most[worst] / KN)} kN in {name}, {share}{part}"


def _way_out(file, otherwise):
    """MOVE where lines were static that could move, else what is given"""
    return MOVE if any(line.startswith(OF_LINES) for line in told(file)) else otherwise


def anchors_in_runs(file):
    """Anchors of the lines, None without one, and the largest pulls there in all runs, (lines,) N along the bed and up;
    () without lines"""
    if "anchor_pull" not in file:
        return ()
    given = json.loads(file.attrs["anchors"]) if "anchors" in file.attrs else [None] * len(file["line"])
    return [one and stored_anchor(one) for one in given], *file["anchor_pull"][()][whole_rows(file)].max(axis=0).T


def bed_in_runs(file):
    """m of each line on the bed at rest, and the least at the largest tension of a run, (lines,); () without lines"""
    if "on_bed" not in file:
        return ()
    return np.asarray(file.attrs["on_bed_at_rest"], float), file["on_bed"][()][whole_rows(file)].min(axis=0)


def excursion_in_runs(file):
    """m, largest horizontal distance of a body from rest in all runs"""
    return float(file["excursion"][()][whole_rows(file)].max())


def lifted(names, anchors, along, up, at_rest):
    """A finding on lines that lie on the bed at rest, have no [[anchors]], and pull their anchors upward in the runs"""
    found = [i for i, one in enumerate(anchors) if one is None and at_rest[i] > 0 and up[i] > LIFTED * along[i]]
    if found:
        worst = max(found, key=lambda i: up[i])
        yield (
            f"{len(found)} of {len(names)} lines leave the bed and pull their anchors upward in the runs, most of all "
            f"{names[worst]} with {up[worst] / KN:.3g} kN: a drag anchor holds a horizontal pull only; give longer or "
            "heavier lines, or anchors that hold it, as [[anchors]]"
        )


def on_anchors(file):
    """Failures and findings of the anchors"""
    found, names = anchors_in_runs(file), list(file["line"].asstr()[()])
    if not found:
        return ()
    return (*anchor_findings(names, *found, "in the runs"), *lifted(names, *found, bed_in_runs(file)[0]))


def notes(file):
    """Notes on the meaning of the largest values"""
    runs = int(whole_rows(file).sum())
    share, sure = 100 * share_beyond(runs), 100 * CONFIDENCE
    further = f"with {sure:.0f} % confidence, no more than {share:.2g} % of further runs exceed it"
    if not differ(file):
        yield (
            "seeds do not differ, since there are no random waves or gusts: every run has the same largest "
            "and smallest values"
        )
    elif runs < FEWEST:
        yield (
            f"the largest is the largest value in {runs} run{'s' * (runs != 1)}; {further}; run {FEWEST} "
            "seeds for a median extreme with its interval"
        )
    else:
        yield (
            "the median extreme is exceeded by half of such runs, and its interval holds for any distribution of the "
            f"largest values; the largest is the largest value in {runs} runs; {further}"
        )


def differ(file):
    """Whether runs differ between seeds: by irregular waves or gusts"""
    known = file.attrs.get("seeds_differ")
    return differ_by(make_study(tomllib.loads(file.attrs["study"]))) if known is None else bool(known)


def rare_findings(file):
    """Lines that snap, and fenders that are touched, in few of the runs"""
    for kind, what, way_out in (
        ("tension", "lines that snap taut", _way_out(file, "use longer lines or more pretension")),
        ("deflection", "fenders that are hit", "run more seeds to see how often"),
    ):
        largest, names = largest_in_runs(file, kind)
        found = [(name, n) for name, n in zip(names, rare(largest), strict=True) if n]
        if found:
            named = some([f"{name} in {n} of {len(largest)}" for name, n in found], LINES_NAMED)
            yield (
                f"{what} in few runs: in some ({named}) the largest {kind} exceeds {RARE:g} times its median "
                f"over all runs, and the next run may far exceed the simulated values; {way_out}"
            )
