"""A page of curves from a database: one column per degree of freedom, one row per kind of result.

Curves are those of `bem.database.reader` between the stored frequencies, with a point at every resonance. Straight
lines between a dozen frequencies, chosen for smooth coefficients, would not show the resonances.
"""

from functools import cached_property

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.database import DatabaseError
from hakobune.bem.database.between_frequencies import DRIFT, FEWEST, BetweenError
from hakobune.bem.database.resonances import about, resonances
from hakobune.bem.database.schema import DRIFT_DOFS, QUANTITIES

from ..common.gaps import gaps_of
from ..common.picture import save

PREFIXES = ((1e9, "G", "10⁹ "), (1e6, "M", "10⁶ "), (1e3, "k", "10³ "))
QUIET = 1e-6  # curves below this fraction of the largest of their kind count as zero by symmetry
FAINT = 1e-3  # forces below this fraction of the largest on a motion have a phase that depends on the mesh
FORCES, MOMENTS = slice(0, 3), slice(3, 6)
PLACES = 300  # frequencies of a curve, in addition to stored ones and those about resonances
MARKED = 30  # largest number of marked stored frequencies; more would form a thick line
SIZE = 17.0, 2.35  # inches: width of the page, and height of a row of curves with its margins
ON_PAPER = 11.0, 1.9  # the same for a sheet of paper, on which it is reduced less
NARROW = 1.5  # inches wide: the name of the first row is above that of its first column
MARGINS = {"left": 0.66, "right": 0.08, "bottom": 0.45, "top": 0.7, "between": 0.78, "rows": 0.42}  # inches
LABEL = 0.5  # inches from a curve's axis to the name of its unit
TICKS = 5  # largest number of tick intervals of a curve; frequencies have ticks once per column
FREQUENCIES = 8, 4  # spaces between ticks of frequencies, at most, of wide and narrow columns
GRID = {"color": "0.9", "linewidth": 0.6}
HEADINGS = 5  # largest number of headings drawn; more colours cannot be distinguished
HIGH = 5  # factor on the motion away from a sharp resonance; a higher peak is labelled and cut off
ROWS = {
    "A and B/ω": ("added_mass", "radiation_damping"),
    "excitation": ("excitation_force",),
    "phase lag": ("excitation_force",),
    "response": ("rao",),
    "mean drift": ("drift_force_fixed", "drift_force"),
}


class Curves:
    """A database at frequencies `omega` (q,) rad/s that show all its values; `stored` (n,) are the numbers of the
    stored frequencies

    gaps : `gaps.Gaps` of the database, without values
    """

    def __init__(self, db, gaps):
        self.gaps = gaps
        self.db, self.mesh, self.names, self.wave_direction = db, db.mesh, db.names, db.wave_direction
        if len(db.omega) >= FEWEST:
            low, high = db.omega[[0, -1]]
            sharp = [] if self.body is None else about(self.body, self.peaks)
            self.omega = np.unique(np.concatenate([np.linspace(low, high, PLACES)[1:-1], db.omega, sharp]))
        else:
            self.omega = db.omega
        broken = [0.5 * (low + high) for low, high in gaps.spans if db.omega[0] <= low and high <= db.omega[-1]]
        self.omega = np.union1d(self.omega, broken)
        self.stored = np.searchsorted(self.omega, db.omega)
        self.headings = shown_headings(db.wave_direction, db.mesh.symmetry)

    def __getitem__(self, name):
        """Values (q, …) of the reader; where it has none between the stored ones, linear interpolation"""
        value = np.array(self._value(name))
        for low, high in self.gaps.spans:
            value[(self.omega > low) & (self.omega < high)] = np.nan
        return value

    def _value(self, name):
        stored, body = self.db[name], self.body
        if len(self.omega) == len(self.db.omega):
            return stored
        try:
            if body is None or not np.all(np.isfinite(stored)):
                raise BetweenError(name)
            if name == "rao":
                return body.motions(self.omega)
            if name in DRIFT and body.rebuilds_drift:
                return body.drift(self.omega, fixed=name == DRIFT[0])
            if name not in DRIFT:
                return body.between.value(self.omega, name)
        except (BetweenError, FloatingPointError):
            pass
        high = np.clip(np.searchsorted(self.db.omega, self.omega), 1, len(stored) - 1)
        share = (self.omega - self.db.omega[high - 1]) / (self.db.omega[high] - self.db.omega[high - 1])
        share = share.reshape(-1, *[1] * (stored.ndim - 1))
        return (1 - share) * stored[high - 1] + share * stored[high]

    @cached_property
    def body(self):
        """`Reader`; None if values are missing at some frequencies, which excludes interpolation"""
        try:
            return getattr(self.db, "reader", None)
        except BetweenError:
            return None

    @cached_property
    def peaks(self):
        """[Resonance] of the freely floating body"""
        known = self.body is not None and "rao" in self.names and len(self.db.omega) >= FEWEST
        return resonances(self.body) if known else []


def plot(db, output, size=SIZE):
    """Draw the content of the database to `output` (.png, .svg or .pdf); returns the matplotlib figure.

    size : inches, width of the page and height of a row

    Raises DatabaseError if it has nothing to draw.
    """
    import matplotlib
    from matplotlib.figure import Figure

    rows = [row for row, names in ROWS.items() if any(name in db.names for name in names)]
    if not rows or not len(db.omega):
        again = f"'hakobune solve SCENE --output {db.path}', or the command that made it, continues"
        raise DatabaseError(f"{db.path} contains no solved curve; {again}")
    with matplotlib.rc_context({"font.size": 8, "axes.titlesize": 9, "svg.fonttype": "none"}):
        figure, grid = _page(Figure, len(rows), *size)
        curves = Curves(db, gaps_of(db))
        _same_frequencies(grid[0, 0], curves.gaps.asked)
        for name, axes in zip(rows, grid, strict=True):
            DRAW[name](curves, axes)
        _dress(db, figure, grid, curves)
        save(figure, output, 130)
    return figure


def _page(figure, rows, width, row):
    """A figure with `rows` rows of axes, and these (rows, 6); width, row : as `SIZE`

    All places are given in inches: matplotlib's automatic layout measures every tick of the page twice, which took
    longer than everything else.
    """
    height = MARGINS["top"] + MARGINS["bottom"] + row * rows - MARGINS["rows"]
    page = figure(figsize=(width, height))
    wide = (width - MARGINS["left"] - MARGINS["right"] - 5 * MARGINS["between"]) / 6
    high = row - MARGINS["rows"]
    sides = {"left": MARGINS["left"] / width, "right": 1 - MARGINS["right"] / width}
    sides |= {"bottom": MARGINS["bottom"] / height, "top": 1 - MARGINS["top"] / height}
    spaces = {"wspace": MARGINS["between"] / wide, "hspace": MARGINS["rows"] / high}
    grid = page.subplots(rows, 6, sharex=True, squeeze=False, gridspec_kw=sides | spaces)
    for axis in grid.flat:
        axis.set_title("", y=1.0)
        axis.locator_params(axis="y", nbins=TICKS)
        axis.yaxis.set_label_coords(-LABEL / wide, 0.5)
        axis.xaxis.set_label_coords(0.5, -0.3 / high)
    return page, grid


def _same_frequencies(axis, omega):
    """Limits of the frequencies of all curves, which matplotlib would otherwise search again for every curve"""
    low, high = omega[[0, -1]]
    if low < high:
        axis.set_xlim(low - axis.margins()[0] * (high - low), high + axis.margins()[0] * (high - low))


def shown_headings(headings, symmetry):
    """Indices of at most HEADINGS of headings (m,) rad, evenly among those that differ under mirror symmetry"""
    x, y = np.cos(headings), np.sin(headings)
    folded = np.arctan2(np.abs(y) if "y" in symmetry else y, np.abs(x) if "x" in symmetry else x)
    order = np.argsort(np.round(folded, 9), kind="stable")
    different = order[np.concatenate([[True], np.diff(np.round(folded[order], 9)) > 0])]
    some = np.unique(np.linspace(0, len(different) - 1, min(HEADINGS, len(different))).round().astype(int))
    return np.sort(different[some])


def heading_colors(count):
    """Colours from dark to light, none too pale to read on white; shape (count, 4)"""
    from matplotlib import colormaps

    return colormaps["viridis"](np.linspace(0.0, 0.85, count))


def _coefficients(db, axes):
    curves = {}
    if "added_mass" in db.names:
        curves["A", "-"] = np.einsum("wii->wi", db["added_mass"])
    if "radiation_damping" in db.names:
        curves["B/ω", "--"] = np.einsum("wii->wi", db["radiation_damping"]) / db.omega[:, None]
    size = np.max([_most(np.abs(curve), 0) for curve in curves.values()], axis=0)
    shown = size > QUIET * _largest_of_kind(size, _length(db) ** 2)
    for columns, unit in ((FORCES, "kg"), (MOMENTS, "kg m²")):
        scale, _, power = _prefix(size[columns].max())
        for i in range(6)[columns]:
            for (label, style), curve in curves.items() if shown[i] else ():
                _curve(axes[i], db, curve[:, i] / scale, style, "C0" if style == "-" else "C3", label)
            axes[i].set_ylabel(f"{power}{unit}")
    if shown.any():
        axes[np.argmax(shown)].legend(frameon=False)


def _excitation(db, axes):
    _amplitudes(db, axes, np.abs(db["excitation_force"]), ("N/m", "N m/m"), _length(db))


def _phases(db, axes):
    force = db["excitation_force"]
    size = np.abs(force)
    shown = _above_rounding(size, _length(db)) & (_most(size, 0) > FAINT * _most(size, (0, 1)))
    for i, axis in enumerate(axes):
        for j, color in zip(db.headings, heading_colors(len(db.headings)), strict=True):
            if shown[j, i]:
                lag = np.degrees(np.angle(force[:, j, i]))
                _curve(axis, db, _broken_at_jumps(lag), "-", color)
        axis.set(ylim=(-190, 190), yticks=(-180, -90, 0, 90, 180), ylabel="degrees")


def _responses(db, axes):
    response = np.abs(db["rao"])
    response[:, :, MOMENTS] = np.degrees(response[:, :, MOMENTS])
    _amplitudes(db, axes, response, ("m/m", "°/m"), np.degrees(1 / _length(db)), prefixes=False)
    for i in range(6) if db.peaks else ():
        _cut(axes[i], db.peaks, db.omega, response[:, :, i])


def _cut(axis, peaks, omega, size):
    """Limit the axis to exclude a dominating peak, and label the peak with its resonance"""
    at = omega[_most(size, 1).argmax()]
    one = min(peaks, key=lambda one: abs(np.log(one.omega / at)))
    near = np.abs(omega / one.omega - 1) < max(0.1, 2 * one.damping)
    highest, top = _most(size[near], None), HIGH * _most(size[~near], None)
    if axis.lines and 0 < top < highest:
        axis.set_ylim(0, top)
        axis.annotate(
            f"{highest:.3g} at {one.omega:.4g} rad/s\ndamping ratio {one.damping:.2g}", (one.omega, top),
            xytext=(6, -3), textcoords="offset points", va="top", color="0.3",
        )  # fmt: skip


def _drift(db, axes):
    styles = {"drift_force": "-", "drift_force_fixed": "--"}
    drift = {name: db[name] for name in styles if name in db.names}
    places = {name: DOFS.index(name) for name in DRIFT_DOFS}
    size = np.max([_most(np.abs(value), (0, 1)) for value in drift.values()], axis=0)
    forces, moment = size[:2].max(), size[2]
    for part, dof in enumerate(places):
        largest = forces if dof != "Yaw" else moment
        floor = QUIET * (forces if dof != "Yaw" else max(moment, forces * _length(db)))
        scale, prefix, _ = _prefix(largest)
        axis = axes[places[dof]]
        for name, value in drift.items():
            for j, color in zip(db.headings, heading_colors(len(db.headings)), strict=True):
                if _most(np.abs(value[:, j, part]), None) > floor:
                    _curve(axis, db, value[:, j, part] / scale, styles[name], color)
        if axis.lines:
            axis.axhline(0, color="0.6", linewidth=0.6)
        axis.set_ylabel(f"{prefix}{'N m/m²' if dof == 'Yaw' else 'N/m²'}")
    for i in set(range(6)) - set(places.values()):
        axes[i].set_axis_off()
    words = {"drift_force": "solid: floating freely", "drift_force_fixed": "dashed: held fixed"}
    axes[2].text(0.02, 0.6, "\n".join(words[name] for name in drift), transform=axes[2].transAxes, va="center")


DRAW = dict(zip(ROWS, (_coefficients, _excitation, _phases, _responses, _drift), strict=True))


def _most(size, axis):
    """Largest of the known values, 0 without any"""
    return np.where(np.isfinite(size), size, 0.0).max(axis=axis, initial=0.0)


def _length(db):
    """m, the longer side of the hull seen from above: the lever of forces"""
    return float(np.ptp(db.mesh.whole().vertices.reshape(-1, 3), axis=0)[:2].max())


def _largest_of_kind(size, lever):
    """Scale below which forces and moments are rounding; shape (6,): the largest of their kind, or force times lever"""
    forces, moments = size[..., FORCES].max(), size[..., MOMENTS].max()
    return np.repeat([forces, max(moments, forces * lever)], 3)


def _above_rounding(size, lever):
    """Whether a curve of `size` (n, m, 6) exceeds rounding; shape (m, 6)"""
    return _most(size, 0) > QUIET * _largest_of_kind(_most(size, (0, 1)), lever)


def _amplitudes(db, axes, size, units, lever, prefixes=True):
    shown = _above_rounding(size, lever)
    for columns, unit in zip((FORCES, MOMENTS), units, strict=True):
        scale, prefix, _ = _prefix(_most(size[:, :, columns], None)) if prefixes else (1.0, "", "")
        for i in range(6)[columns]:
            for j, color in zip(db.headings, heading_colors(len(db.headings)), strict=True):
                if shown[j, i]:
                    _curve(axes[i], db, size[:, j, i] / scale, "-", color)
            axes[i].set_ylabel(f"{prefix}{unit}")
            axes[i].set_ylim(bottom=0)


def _curve(axis, db, value, style, color, label=None):
    marker = "o" if len(db.stored) <= MARKED else None
    axis.plot(
        db.omega, value, style, color=color, label=label, linewidth=1.2, marker=marker, markersize=2.2,
        markevery=list(db.stored),
    )  # fmt: skip


def _prefix(largest):
    """Return (factor, SI prefix, power of ten) that give one to three digits before the point"""
    return next((step for step in PREFIXES if largest >= step[0]), (1.0, "", ""))


def _broken_at_jumps(degrees):
    degrees = degrees.copy()
    with np.errstate(invalid="ignore"):
        degrees[1:][np.abs(np.diff(degrees)) > 180] = np.nan
    return degrees


def _dress(db, figure, grid, curves):
    gaps = curves.gaps
    rows = [row for row, names in ROWS.items() if any(name in db.names for name in names)]
    for axis, dof in zip(grid[0], DOFS, strict=True):
        axis.set_title(dof, fontweight="bold", y=1.0)
    narrow = grid[0, 0].get_position().width * figure.get_figwidth() < NARROW
    _share_ticks(grid, FREQUENCIES[int(narrow)])
    for i, (axes, row) in enumerate(zip(grid, rows, strict=True)):
        above = 1.14 if narrow and i == 0 else 1.0
        axes[0].set_title(row, loc="left", fontweight="bold", color="0.35", y=above)
    for (i, j), axis in np.ndenumerate(grid):
        axis.spines[["top", "right"]].set_visible(False)
        if axis.lines:
            axis.grid(True, axis="y", **GRID)
            _mark(axis, gaps)
        elif axis.axison:
            unknown = any(DOFS[j] in gaps.unknown.get(name, ()) for name in ROWS[rows[i]])
            word = "not solved" if unknown else "zero"
            axis.text(0.5, 0.5, word, transform=axis.transAxes, ha="center", color="0.5")
            axis.set_yticks([])
    for axis in grid[-1]:
        axis.set_xlabel("ω  rad/s")
    if any("wave_direction" in QUANTITIES[name][0] for row in rows for name in ROWS[row]):
        _name_headings(db, figure, curves.headings)
    depth = "deep water" if np.isinf(db.water_depth) else f"water {db.water_depth:g} m deep"
    figure.suptitle(
        f"{db.mesh.name or db.path.stem}, {depth}", x=0.01, y=1 - 0.1 / figure.get_figheight(), ha="left", fontsize=12
    )


def _mark(axis, gaps):
    """Shade the unsolved frequencies"""
    for n, (low, high) in enumerate(gaps.spans):
        axis.axvspan(low, high, color="C3", alpha=0.12, lw=0, label="not solved" if n == 0 else None)
    if gaps.spans and axis.get_legend() is not None:
        axis.legend(frameon=False)


def _share_ticks(grid, spaces):
    """Ticks of frequencies for the lowest row alone, and lines at their places in all: a tick takes a millisecond

    spaces : between them, at most
    """
    from matplotlib.collections import LineCollection
    from matplotlib.ticker import MaxNLocator

    low, high = grid[0, 0].get_xlim()
    places = [place for place in MaxNLocator(spaces).tick_values(low, high) if low <= place <= high]
    grid[0, 0].set(xticks=places, xlim=(low, high))
    for axis in grid.flat:
        if axis.axison and axis.lines:
            lines = LineCollection(
                [[(place, 0), (place, 1)] for place in places], transform=axis.get_xaxis_transform(), zorder=1, **GRID
            )  # fmt: skip
            axis.add_collection(lines, autolim=False)
    for axis in grid[:-1].flat:
        axis.xaxis.set_visible(False)


def _name_headings(db, figure, shown):
    from matplotlib.lines import Line2D

    angles = np.degrees(db.wave_direction[shown])
    handles = [
        Line2D([], [], color=color, label=f"{angle:g}°")
        for angle, color in zip(angles, heading_colors(len(angles)), strict=True)
    ]
    left_out = len(db.wave_direction) - len(shown)
    title = "waves travel to" + f" ({left_out} more, similar or in between)" * bool(left_out)
    figure.legend(handles=handles, title=title, ncols=len(handles), loc="upper right", frameon=False)
