"""Pictures of a simulation: records, spectra, watch circle, tension against offset, exceedance."""

import gc
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.mooring.motion.statistics import FEW, frequencies_in, in_plane, settled_from, slow_part

from ..common.picture import save
from ..common.units import KN
from .file import STATISTICS, bodies_of, opened, ropes_of, units_of, whole_rows

SHOWN = 600.0  # s of a record
MOTIONS = (("surge", 1.0, "m"), ("sway", 1.0, "m"), ("heave", 1.0, "m"), ("roll", 180 / np.pi, "°"),
           ("pitch", 180 / np.pi, "°"), ("yaw", 180 / np.pi, "°"))  # fmt: skip
OF_HINGES = {"N": (1 / KN, "kN"), "N m": (1 / KN, "kN m"), "m": (1.0, "m"), "rad": (180 / np.pi, "°")}
PRESSED = "deflection", 1.0, "m"  # of fenders
SMOOTH = 20  # number of neighbouring frequencies averaged in one value of a spectrum
FINE, BEYOND = 0.15, 10.0  # a value's width and the end of spectra, at most, over the split frequency
LAST = 2.0  # rad/s, end of spectra, or that of shorter waves
PLANE = (0, 1, 5)  # motions without hydrostatic restoring
MOST_POINTS = 20_000


def prepare():
    """Load matplotlib, for a process that will draw and has time before"""
    import matplotlib.backends.backend_agg
    import matplotlib.figure  # noqa: F401

    gc.freeze()  # what is loaded stays: to search it for cycles took a fifth of the time of the pictures


def draw_run(output):
    """`draw` of the file at a path"""
    with opened(output) as file:
        return draw(file, Path(output))


def draw(file, output):
    """Write the pictures next to the file of a run; returns their names.  None without a complete record."""
    kept = np.flatnonzero(whole_rows(file)[: len(file["kept_seed"])])
    if not len(kept):
        return []
    made = []
    for motions in _motions(file):
        body = motions.before.strip()
        for name, picture in (
            ("records", _records), ("spectra", _spectra), ("offsets", _offsets), ("extremes", _extremes)
        ):  # fmt: skip
            path = output.with_name("_".join(filter(None, (output.stem, body, name))) + ".png")
            picture(file, kept, path, motions)
            made.append(path.name)
    if "hinge" in file:
        path = output.with_name(f"{output.stem}_hinges.png")
        _hinges(file, kept, path)
        made.append(path.name)
    return made


class Motions(NamedTuple):
    """Motions of one body: its number, and the prefix of their names

    still : names of the quantities that are constant in all runs; worst : `Worst` of the file
    """

    body: int
    before: str
    still: frozenset[str]
    worst: "Worst"

    @property
    def named(self):
        """Return (name, factor to its unit, unit) of each"""
        return _named(self.before)

    def of(self, file, kept):
        """Records of rows that are kept; shape (…, n, 6)"""
        return file["motion"][kept][..., 6 * self.body : 6 * self.body + 6]


def _motions(file):
    """[Motions] of each body of a file"""
    still, worst = _still(file), _worst(file)
    return [Motions(i, before, still, worst) for i, before in enumerate(_prefixes(file))]


def _named(before):
    return tuple((before + name, factor, unit) for name, factor, unit in MOTIONS)


def _prefixes(file):
    """Prefix of the names of motions of each body"""
    return [f"{body} ".lstrip() for body in bodies_of(file) or ("",)]


def _still(file):
    """Names of the quantities that are constant in all runs"""
    varies = file["statistics"][()][whole_rows(file)][:, :, STATISTICS.index("sigma")].any(axis=0)
    return frozenset(file["quantity"].asstr()[()][~varies])


def draw_one(file, name, path, body=0):
    """Draw "records" or "offsets" of a file to `path`, of several bodies those of number `body`.  Raises ValueError
    without a complete record."""
    kept = np.flatnonzero(whole_rows(file)[: len(file["kept_seed"])])
    if not len(kept):
        raise ValueError("no record of a run is kept")
    {"records": _records, "offsets": _offsets}[name](file, kept, path, _motions(file)[body])


def _figure(rows, columns, size, between=0.12, title=0.6, **more):
    """Figure and axes of a size in inches, with room for their labels; `between` : share of its height between rows

    title : inches above them

    Automatic layouts of matplotlib draw everything four times.
    """
    from matplotlib.figure import Figure

    figure, (width, height) = Figure(figsize=size), size
    figure.subplots_adjust(1.1 / width, 0.55 / height, 1 - 0.2 / width, 1 - title / height, 0.28, between)
    return figure, figure.subplots(rows, columns, squeeze=False, **more)


class Worst(NamedTuple):
    """The line with the largest tension of all runs. Without lines it is the fender with the largest deflection;
    without fenders too, the motion that takes the hull farthest from rest

    kind : "tension", "deflection" or "motion", its dataset; at : its place there; factor : to its unit
    """

    kind: str
    at: int
    name: str
    factor: float
    unit: str

    @property
    def quantity(self):
        """The name of the quantity in the file"""
        return self.name if self.kind == "motion" else f"{self.kind} {self.name}"


def _worst(file):
    found = _largest_of(file, "tension", 1 / KN, "kN") if len(file["line"]) else _largest_of(file, *PRESSED)
    if found is not None:
        return found
    motions = [one for before in _prefixes(file) for one in _named(before)]
    at = int(np.argmax(_travel(file, len(motions))))
    return Worst("motion", at, *motions[at])


def _largest_of(file, kind, factor, unit):
    """`Worst` of the tensions or of the deflections, None without any"""
    names = file["quantity"].asstr()[()]
    chosen = [i for i, name in enumerate(names) if name.startswith(f"{kind} ")]
    if not chosen:
        return None
    largest = file["statistics"][()][whole_rows(file)][:, chosen, STATISTICS.index("largest")]
    at = int(np.argmax(largest.max(axis=0)))
    return Worst(kind, at, names[chosen[at]].removeprefix(f"{kind} "), factor, unit)


def _travel(file, count):
    """(count,) m that each motion takes the hull from rest, either way; rotations at its sides and ends"""
    length, beam = file.attrs["hull"][:2]
    arms = np.resize([1.0, 1.0, 1.0, beam / 2, length / 2, length / 2], count)
    places = [STATISTICS.index(end) for end in ("smallest", "largest")]
    ends = file["statistics"][()][whole_rows(file)][:, :count, places]
    return arms * np.abs(ends).max(axis=(0, 2))


def _records(file, kept, path, motions):
    """The minutes around the largest tension, in its run"""
    worst, time = motions.worst, file["time"][()]
    either = np.abs if worst.kind == "motion" else np.asarray  # the way of a motion does not matter
    row = max(kept, key=lambda i: either(file[worst.kind][i, :, worst.at]).max())
    record = file[worst.kind][row, :, worst.at]
    at = time[int(np.argmax(either(record)))]
    begin = min(max(at - SHOWN / 2, time[0]), max(time[-1] - SHOWN, time[0]))
    part = (time >= begin) & (time <= begin + SHOWN)
    moving = [j for j, (name, _, _) in enumerate(motions.named) if name not in motions.still]
    fender = _largest_of(file, *PRESSED) if worst.kind == "tension" else None
    count = len(moving) + 2 + (fender is not None)
    figure, axes = _figure(count, 1, (11, 1 + 1.5 * count), sharex=True)
    axes, last = axes[:, 0], axes[len(moving) + 1, 0]
    axes[0].plot(time[part], file["wave"][row][part], color="C0", lw=0.9)
    axes[0].set_ylabel("wave, m")
    step, split = float(np.diff(time[:2])[0]), float(file.attrs["split_frequency"])
    for one, j in zip(axes[1 : len(moving) + 1], moving, strict=True):
        name, factor, unit = motions.named[j]
        motion = factor * motions.of(file, row)[:, j].astype(float)
        one.plot(time[part], motion[part], color="0.25", lw=0.9)
        if j in PLANE:
            there_and_back = np.concatenate([motion, motion[::-1]])  # a record whose ends differ would ring
            one.plot(time[part], slow_part(there_and_back, step, split)[: len(time)][part], color="C3", lw=1.4)
        one.set_ylabel(f"{name}, {unit}")
    last.plot(time[part], worst.factor * record[part], color="C1", lw=0.9)
    _breaking(last, file, worst, record.max())
    last.set_ylabel(f"{worst.kind}, {worst.unit}\n{worst.name}")
    if fender is not None:
        axes[-1].plot(time[part], file["deflection"][row, part, fender.at], color="C2", lw=0.9)
        axes[-1].set_ylabel(f"deflection, m\n{fender.name}")
    axes[-1].set(xlabel="s after the ramp", xlim=(begin, min(begin + SHOWN, time[-1])))
    slow = f"; red: slow part, below {split:.2g} rad/s" * any(j in PLANE for j in moving)
    axes[0].set_title(f"seed {file['seed'][row]}, around the largest {worst.kind}, in {worst.name}{slow}", loc="left")
    for one in axes:
        one.grid(alpha=0.3)
    save(figure, path, 110)


def _hinges(file, kept, path):
    """All numbers of the hinge with the largest force, in the minutes around it, in its run"""
    names, units = (
        file["hinge"].asstr()[()].tolist(),
        dict(zip(file["quantity"].asstr()[()], units_of(file), strict=True)),
    )
    forces = [i for i, name in enumerate(names) if units[name] == "N"]
    pulls = np.abs(file["links"][kept][:, :, forces])
    run, at, which = np.unravel_index(int(np.argmax(pulls)), pulls.shape)
    hinge = names[forces[which]].rpartition(" force ")[0]
    own = [
        i for i, name in enumerate(names) if name.startswith((f"{hinge} force ", f"{hinge} moment ", f"{hinge} travel"))
    ]
    time = file["time"][()]
    begin = min(max(time[at] - SHOWN / 2, time[0]), max(time[-1] - SHOWN, time[0]))
    part = (time >= begin) & (time <= begin + SHOWN)
    figure, axes = _figure(len(own), 1, (11, 1 + 1.5 * len(own)), sharex=True)
    for one, i in zip(axes[:, 0], own, strict=True):
        factor, unit = OF_HINGES[units[names[i]]]
        one.plot(time[part], factor * file["links"][kept[run], part, i], color="0.25", lw=0.9)
        one.set_ylabel(f"{names[i].removeprefix(hinge).strip()}, {unit}")
        one.grid(alpha=0.3)
    axes[-1, 0].set(xlabel="s after the ramp", xlim=(begin, min(begin + SHOWN, time[-1])))
    axes[0, 0].set_title(f"seed {file['seed'][kept[run]]}, around the largest force of a hinge, in {hinge}", loc="left")
    save(figure, path, 110)


def _runs(kept):
    return "1 run" if len(kept) == 1 else f"{len(kept)} runs"


def _breaking(axes, file, worst, top):
    load = file.attrs["breaking_load"][worst.at] if worst.kind == "tension" else np.inf
    if load < 2 * top:
        axes.axhline(load / KN, color="C3", lw=1, ls="--")
        axes.annotate("breaking load", (0.01, load / KN), xycoords=("axes fraction", "data"), va="top", fontsize=8)


def spectrum(records, step, widest=np.inf):
    """ω (rad/s) and density of records (runs, n), the mean over runs and over neighbouring frequencies

    widest : rad/s, largest range of the frequencies in a mean
    """
    y = records - records.mean(axis=1, keepdims=True)
    density = 2 * np.mean(np.abs(np.fft.rfft(y, axis=1)) ** 2, axis=0) * step / (2 * np.pi * y.shape[1])
    omega = 2 * np.pi * np.fft.rfftfreq(y.shape[1], step)
    count = max(1, int(min(SMOOTH // len(records), widest / omega[1])))
    whole = (len(omega) - 1) // count * count
    return (part[1 : whole + 1].reshape(-1, count).mean(axis=1) for part in (omega, density))


def _has_spectrum(motions, name, records):
    """Whether a quantity varies, with enough frequencies for a meaningful spectrum and maxima"""
    return name not in motions.still and max(map(frequencies_in, records.astype(float))) > FEW


def _reach(waves, step):
    """rad/s, up to which a spectrum of waves (runs, n) has all but 1 % of its energy"""
    omega, density = (np.asarray(part) for part in spectrum(waves.astype(float), step))
    return omega[np.searchsorted(np.cumsum(density), 0.99 * density.sum())] if density.any() else 0.0


def _spectra(file, kept, path, motions):
    step, worst = float(np.diff(file["time"][:2])[0]), motions.worst
    split = float(file.attrs["split_frequency"])
    last = min(max(LAST, _reach(file["wave"][kept], step)), BEYOND * split)
    figure, axes = _figure(2, 4, (15, 7), 0.32)
    columns = [("wave", 1.0, "m", file["wave"][kept])]
    own = motions.of(file, kept)
    columns += [(name, f, unit, own[..., j]) for j, (name, f, unit) in enumerate(motions.named)]
    columns.append((worst.quantity, worst.factor, worst.unit, file[worst.kind][kept, :, worst.at]))
    for one, (name, factor, unit, records) in zip(axes.flat, columns, strict=True):
        if not _has_spectrum(motions, name, records):
            one.set(title=name, xticks=[], yticks=[])
            why = "does not vary" if name in motions.still else "few frequencies:\nno spectrum"
            one.text(0.5, 0.5, why, ha="center", va="center")
            continue
        omega, density = spectrum(factor * records.astype(float), step, FINE * split)
        shown = omega < last
        one.plot(omega[shown], density[shown], lw=1.1)
        one.axvline(split, color="0.6", lw=0.8, ls=":")
        one.set(title=name, xlabel="rad/s", ylabel=f"{unit}² s/rad", xlim=(0, last), ylim=(0, None))
        one.grid(alpha=0.3)
    figure.suptitle(f"spectra, mean of {_runs(kept)}; dotted: limit of slow and wave part", fontsize=10, y=0.985)
    save(figure, path, 110)


def _offsets(file, kept, path, motions):
    """Watch circle, and the tension of the worst line against the offset along its pull"""
    worst = motions.worst
    motion = motions.of(file, kept) * [name not in motions.still for name, _, _ in motions.named]
    x, y = motion[..., 0].ravel(), motion[..., 1].ravel()
    lost, time = float(file.attrs.get("lost_at", np.inf)), file["time"][()]
    late = np.concatenate([np.arange(len(time)) >= settled_from(time, in_plane(one), lost) for one in motion])
    step = max(1, len(x) // MOST_POINTS)
    figure, ((plan, curve),) = _figure(1, 2, (13, 6.2))
    plan.plot(x[::step], y[::step], ".", ms=1.5, color="C0", alpha=0.35)
    rest = file.attrs["place_at_rest"][6 * motions.body : 6 * motions.body + 2]
    centre = rest if late.all() else np.array([x[late].mean(), y[late].mean()])
    away = np.where(late, np.hypot(x - centre[0], y - centre[1]), 0.0)
    farthest, radius = away.argmax(), away.max()
    angle = np.linspace(0, 2 * np.pi, 200)
    plan.plot(centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle), color="C3", lw=1)
    plan.plot(x[farthest], y[farthest], "x", ms=7, color="C3", label="farthest")
    plan.plot(*rest, "k+", ms=10, label="at rest")
    plan.plot(x[late].mean(), y[late].mean(), "o", color="C3", ms=5, label="mean")
    along, across = ("surge", "sway") if motions.before else ("x", "y")
    plan.set(
        xlabel=f"{motions.before}{along}, m",
        ylabel=f"{motions.before}{across}, m",
        aspect="equal",
        title=f"watch circle of {_runs(kept)}, radius {radius:.3g} m about "
        + ("rest" if late.all() else "the mean at the new place"),
    )
    plan.legend(frameon=False, fontsize=8)
    if worst.kind == "tension" and not motions.before:
        _against_offset(curve, file, worst, motion, file["tension"][kept, :, worst.at].ravel(), step)
    else:
        pressed = file[worst.kind][kept, :, worst.at].ravel()
        curve.plot(y[::step], worst.factor * pressed[::step], ".", ms=1.5, color="C1", alpha=0.35)
        curve.set(xlabel=f"{motions.before}sway, m", ylabel=f"{worst.kind}, {worst.unit}")
    curve.set_title(f"{worst.name}, {_runs(kept)}")
    for one in (plan, curve):
        one.grid(alpha=0.3)
    save(figure, path, 120)


def _against_offset(curve, file, worst, motion, pull, step):
    """Pull (n,) N of a line over the offset of its fairlead away from its anchor, one point of `step`"""
    x, y = motion[..., 0].ravel(), motion[..., 1].ravel()
    away = file["fairlead"][worst.at, :2] - file["anchor"][worst.at, :2]
    away = away / np.hypot(*away)
    arm = file["fairlead"][worst.at, :2] - file.attrs["rotation_center"][:2]
    yaw = motion[..., 5].ravel()
    turned = np.stack([np.cos(yaw) * arm[0] - np.sin(yaw) * arm[1], np.sin(yaw) * arm[0] + np.cos(yaw) * arm[1]])
    offset = (np.stack([x, y]) + turned - arm[:, None]).T @ away
    curve.plot(offset[::step], pull[::step] / KN, ".", ms=1.5, color="C1", alpha=0.35)
    largest = pull.argmax()  # the shown points may leave it out
    curve.plot(offset[largest], pull[largest] / KN, "x", ms=7, color="C3")
    _breaking(curve, file, worst, pull.max())
    end = "bollard" if file["line"].asstr()[worst.at] in ropes_of(file) else "anchor"
    curve.set(xlabel=f"offset of the fairlead away from its {end}, m", ylabel="tension, kN")


def _extremes(file, kept, path, motions):
    """Share of maxima above a level, of motions in standard deviations and of tensions"""
    from hakobune.mooring.environment.crossings import local_maxima

    figure, ((left, right),) = _figure(1, 2, (13, 6), title=0.32)
    figure.suptitle(f"maxima in {_runs(kept)}", fontsize=10, y=0.985)
    least = 1.0
    for j, (name, _, _) in enumerate(motions.named):
        records = motions.of(file, kept)[..., j].astype(float)
        if _has_spectrum(motions, name, records):
            tops = _maxima(records, local_maxima) / records.std(axis=1).mean()
            if not len(tops):  # pushed to one side by a given force, or too short a run
                continue
            least = min(least, 0.3 / len(tops))
            left.semilogy(tops, (np.arange(len(tops)) + 0.5) / len(tops), lw=1.2, label=name)
    level = np.linspace(0, 5, 200)
    if left.lines:
        left.semilogy(level, np.exp(-0.5 * level**2), "k--", lw=1, label="Rayleigh")
    left.set(xlabel="maximum from the mean, standard deviations", ylabel="share of maxima above", xlim=(0, 6))
    worst = motions.worst
    held = {"tension": "line", "deflection": "fender"}.get(worst.kind)
    for i, name in enumerate(file[held].asstr()[()] if held else ()):
        records = file[worst.kind][kept, :, i].astype(float)
        if not _has_spectrum(motions, f"{worst.kind} {name}", records):
            continue
        tops = worst.factor * _maxima(records, local_maxima, records.mean(axis=1, keepdims=True))
        style = ("-", "--", ":")[(i + i // 10) % 3]  # there are ten colours; of two that pull alike both are seen
        right.semilogy(tops, (np.arange(len(tops)) + 0.5) / len(tops), style, lw=1.2, label=name)
    right.set(xlabel=f"maximum of the {worst.kind}, {worst.unit}")
    for one in (left, right):
        if one.lines:
            one.set_ylim(least, 1)
            one.grid(alpha=0.3, which="both")
            one.legend(frameon=False, fontsize=8)
        else:
            words = "still, or of few frequencies:\nmaxima have no distribution"
            one.text(0.5, 0.5, words, ha="center", va="center", transform=one.transAxes)
    save(figure, path, 120)


def _maxima(records, local_maxima, level=0.0):
    """All maxima of records (runs, n) in falling order, measured from the mean, plus `level` (runs, 1)"""
    found = []
    for y, add in zip(records - records.mean(axis=1, keepdims=True), np.broadcast_to(level, (len(records), 1)),
                      strict=True):  # fmt: skip
        tops, places = local_maxima(y)
        found.append(tops[places] + add)
    return np.sort(np.concatenate(found))[::-1]
