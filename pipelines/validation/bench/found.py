"""What a bench found, as a result: all jobs, the best of each program, programs at equal panels, one thread and two."""

import math

from ..beside import result
from ..picture import Curve, Panel
from .cases import CASES, HEADING
from .measure import MORE, PASSES, SECONDS
from .peers.repeated import SETTLE

LEVELS = (0.03, 0.01, 0.003, 0.001, 1e-4, 1e-5)
FREQUENCIES = 40  # frequencies that share the preparation of a band
EQUAL = 0.8, 1.07  # panels of the other program over ours that count as equal: rather to its advantage
LEAST = 900  # panels
PEER = "capytaine"
# symmetries of the other program for comparison: single frequencies use the rotation of a cylinder
OURS = {"panel, band": ("2 planes", "rotation"), "panel": ("rotation",)}
SOURCE = "exact solutions of cylinders, and the contour method at 1e-7 of boxes"
NOTES = (
    "error: largest of added mass, damping and excitation, relative to the largest value of that coefficient over "
    "the frequencies; coefficients below a hundredth of their kind left out; worst: which",
    f"warm: mean of five frequencies, {SETTLE:g} s after the first, each the least of {PASSES} passes, or as "
    f"many as {MORE:g} s hold, fewer if they take {SECONDS:g}: six radiating modes and one heading of "
    f"{HEADING:g} degrees; cpu: the same in processor time of all threads",
    "first: from the start of the process to the end of the first frequency, with what programs keep on disk there "
    "(cache full) or not (cache empty); body: that first frequency once everything is loaded, with what frequencies "
    f"share; all in: each of {FREQUENCIES} frequencies with its part of that; estimates of errors are made after all",
    "panel: each frequency alone, by its rotation on a cylinder, but where the commands share the work of these few "
    "(box, 944 panels); panel, band: work that frequencies share, with two planes",
    "panels: on the whole hull; a lid besides, in every program; meshes of other programs are made beforehand",
    "jobs of one thread whose cpu is below 0.9 of their ms are measured again, up to twice: others had the core",
)
STYLES = {
    ("hakobune", "contour"): ("C3", "o"),
    ("hakobune", "panel"): ("C0", "s"),
    ("hakobune", "panel, band"): ("C1", "D"),
    ("capytaine", "direct, graded, 2 planes"): ("C2", "^"),
    ("capytaine", "direct, graded, rotation"): ("C8", "v"),
    ("capytaine", "direct, uniform, 2 planes"): ("0.35", "<"),
    ("capytaine", "direct, graded, 2 planes, Gauss 2"): ("C9", ">"),
    ("capytaine", "indirect, graded, 2 planes"): ("0.6", "d"),
    ("pyhams", "graded, 1 plane"): ("C4", "P"),
    ("pyhams", "uniform, 1 plane"): ("C6", "X"),
}


def result_of(rows, machine):
    """The Result of `measure.Row`s; machine : lines on the machine of each measurement"""
    jobs = [{"job": f"{_name(row)}, {row.cache} cache", **row._asdict(), "panels": row.panels or math.nan}
            for row in rows]  # fmt: skip
    tables = {"job": jobs, "best": best(rows), "pair": equal_panels(rows), "thread": one_thread_and_two(rows)}
    return result("bench", SOURCE, tables, (*machine, *NOTES))


def _name(row):
    return f"{row.case} {row.program} {row.settings} {row.fineness:g}, {row.threads} threads"


def best(rows):
    """[{column: number or text}]: least ms per frequency within each error, by program, body and threads"""
    groups = {}
    for row in _warm(rows):
        name = f"{row.program} {row.settings}" if row.program == "hakobune" else row.program
        groups.setdefault(f"{row.case} {name}, {row.threads} threads", []).append(row)
    return [{"best": name, **{f"within_{level:.0e}_ms": least_ms(own, level) for level in LEVELS}}
            for name, own in sorted(groups.items())]  # fmt: skip


def least_ms(rows, level):
    """Smallest ms per frequency among rows within an error; NaN without such a row"""
    return min((row.warm_ms for row in rows if row.error <= level), default=math.nan)


def equal_panels(rows):
    """[{column: number or text}]: our panels and the other program at its fastest settings, with separate rows for
    mirror planes and for rotation.

    all_in is a frequency of `FREQUENCIES` with its share of the preparation; times : theirs over ours
    """
    out = []
    for ours in (row for row in _warm(rows) if row.settings in OURS and row.panels >= LEAST):
        for symmetry in OURS[ours.settings]:
            theirs = min(_equal(rows, ours, symmetry), key=lambda row: row.warm_ms, default=None)
            if theirs is not None:
                out.append({
                    "pair": f"{_name(ours)}, {PEER} {symmetry}", "warm_ms": ours.warm_ms, "all_in_ms": _all_in(ours),
                    "memory_mb": ours.memory_mb, "their_panels": theirs.panels, "their_warm_ms": theirs.warm_ms,
                    "their_memory_mb": theirs.memory_mb, "times": theirs.warm_ms / ours.warm_ms,
                })  # fmt: skip
    return out


def one_thread_and_two(rows):
    """[{column: number or text}]: ms of one thread over those of two, of our own settings from `LEAST` panels on"""
    out = []
    for two in (row for row in _warm(rows) if row.program == "hakobune" and row.threads == 2):
        one = next((row for row in _warm(rows) if row[:4] == two[:4] and row.threads == 1), None)
        if one and (two.panels is None or two.panels >= LEAST):
            times = one.warm_ms / two.warm_ms
            out.append({"thread": _name(two), "one_ms": one.warm_ms, "two_ms": two.warm_ms, "times": times})
    return out


def _warm(rows):
    return [row for row in rows if row.cache == "full" and not row.note]


def _equal(rows, ours, symmetry):
    return [
        row
        for row in _warm(rows)
        if (row.case, row.program, row.threads) == (ours.case, PEER, ours.threads)
        and symmetry in row.settings
        and EQUAL[0] <= row.panels / ours.panels <= EQUAL[1]
    ]


def _all_in(row):
    """ms; the first frequency comes with the preparation, and with the start of the process if that is all we have"""
    first = 1e3 * row.first_s if math.isnan(row.body_ms) else row.body_ms
    return (first + (FREQUENCIES - 1) * row.warm_ms) / FREQUENCIES


def picture(rows, machine):
    """Arguments of `picture.draw`: error over time per frequency, a panel for each body; threads dashed"""
    panels = []
    for case in CASES.values():
        own = [row for row in _warm(rows) if row.case == case.name]
        if own:
            axes = {"xlabel": "ms per frequency", "ylabel": "largest relative error", "xscale": "log", "yscale": "log"}
            panels.append(Panel(case.title, list(_curves(own)), axes=axes))
    title = f"Error against time of one frequency: six modes and one heading; dashed: several threads.  {machine[0]}"
    return title, panels, min(3, max(1, len(panels))), (5, 4)


def _curves(rows):
    for key, (color, marker) in STYLES.items():
        for threads in sorted({row.threads for row in rows}):
            mine = [row for row in rows if (row.program, row.settings) == key and row.threads == threads]
            mine.sort(key=lambda row: row.fineness if row.fineness >= 1 else 1 / row.fineness)
            style = {"color": color, "marker": marker}
            if threads > 1:
                style |= {"linestyle": "--", "markerfacecolor": "white"}
            if mine:
                x, y = [row.warm_ms for row in mine], [row.error for row in mine]
                yield Curve("" if threads > 1 else " ".join(key), x, y, style)
