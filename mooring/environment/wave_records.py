"""Records of wave elevation: computed from components, written to a file, read from a file.

    η(t) = Re Σ aᵢ exp{i(kᵢ (x cos βᵢ + y sin βᵢ) + εᵢ − ωᵢ t)},    ω² = g k tanh kh

At equal steps exp(−iω(t₀ + pΔ + qδ)) is the product of a coarse and a fine phase. A record of n values then needs
2√n exponentials for each component and one matrix product; it is exact to rounding.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.waves import wavenumber
from hakobune.meshing.seals import write_sealed

from .allowed import positive, row_of_numbers
from .logger_files import read_columns
from .tables import TableError, column_of, fault_of_steps, unit_of, without_rounding

UNEVEN = 0.01  # largest deviation of a time in a file, over the step
FAINT = 1e-6  # components below this fraction of the largest amplitude are omitted
AT_ONCE = 2**21  # phases kept in memory for times on unequal steps


class Record(NamedTuple):
    """elevation (n,) m; step : s; start : s"""

    elevation: np.ndarray
    step: float
    start: float = 0.0

    @property
    def time(self):
        """Times of the record, s; shape (n,)"""
        return self.start + self.step * np.arange(len(self.elevation))


def elevation(components, t, x=0.0, y=0.0, depth=np.inf, gravity=9.80665):
    """Elevation (n,) m at one point.

    components : sea.Components; t : (n,) s; x, y : m; depth : m, may be inf; gravity : m/s²
    """
    t = row_of_numbers("time", t)
    if not (np.isfinite(x) and np.isfinite(y)):
        raise ValueError(f"point is ({x}, {y}) m; allowed: finite")
    if not depth > 0:
        raise ValueError(f"water depth is {depth:g} m; allowed: above 0, or inf")
    omega, a, phase, direction = components
    k = wavenumber(omega, depth, positive("gravity", gravity, "m/s²"))
    X = a * np.exp(1j * (k * (x * np.cos(direction) + y * np.sin(direction)) + phase))
    return real_sum(X, omega, t)


def real_sum(amplitude, omega, t):
    """Re Σ Xᵢ exp(−iωᵢt) → (n,); amplitude : (c,) complex, omega : (c,) rad/s, t : (n,) s"""
    n = len(t)
    step = (t[-1] - t[0]) / max(n - 1, 1)
    if np.all(np.abs(t - (t[0] + step * np.arange(n))) <= 4 * np.finfo(float).eps * np.abs(t).max()):
        return _on_equal_steps(amplitude, omega, t[0], step, n)
    rows = max(1, AT_ONCE // len(omega))
    parts = [np.exp(-1j * np.outer(t[i : i + rows], omega)) @ amplitude for i in range(0, n, rows)]
    return np.concatenate(parts).real


def _on_equal_steps(amplitude, omega, start, step, n):
    block = int(np.ceil(np.sqrt(n)))
    coarse = (amplitude * np.exp(-1j * start * omega)) * _turns(omega, step * block, -(-n // block)).T
    fine = _turns(omega, step, block)
    return (np.hstack([coarse.real, -coarse.imag]) @ np.vstack([fine.real, fine.imag])).ravel()[:n]


def _turns(omega, step, count):
    """exp(−iωt) at `count` steps from 0 s, each a product of two of few: exponentials take longest; shape (c, count)"""
    few = int(np.ceil(np.sqrt(count)))
    long, short = (np.exp(-1j * np.outer(omega, size * np.arange(few))) for size in (step * few, step))
    return (long[:, :, None] * short[:, None]).reshape(len(omega), -1)[:, :count]


def write_record(path, record, comment=""):
    """Write columns time_s and elevation_m as CSV; `comment` precedes the rows in # lines."""
    rows = [f"# {line}" for line in comment.splitlines()] + ["time_s,elevation_m"]
    rows += [f"{t:.6f},{value:.6g}" for t, value in zip(record.time, record.elevation, strict=True)]
    write_sealed(path, "\n".join(rows) + "\n")


def read_record(path, step=None, column=None):
    """Record of a text file (`logger_files`): times and elevations in columns, or elevations alone.

    Units in column names, such as "eta (mm)" and "Time (ms)", are applied.
    step : s, needed if the file has no column of times; otherwise its first column contains the times
    column : name of the column of elevations, by default the second or only column.
    Raises TableError for a file that is not a table, for uneven time steps, and if the step is given twice or not at
    all.
    """
    names, values, lines = read_columns(path)
    if len(values) < 2:
        raise TableError(f"{path} has one row; allowed: 2 or more")
    timed = values.shape[1] > 1
    place = column_of(path, names, column) if column else int(timed)
    gaps = np.flatnonzero(~np.isfinite(values[:, [0, place]]).all(axis=1))
    if len(gaps):
        many = f", the first of {len(gaps)} gaps" if len(gaps) > 1 else ""
        raise TableError(
            f"{path}: line {lines[gaps[0]]} has no finite number{many}; fill in the value, or cut the record there"
        )
    if timed and step is not None:
        raise TableError(f"{path} has a time column, but a step of {step:g} s is given as well; leave out the step")
    if not timed and step is None:
        raise TableError(f"{path} has one column and no times; give the step (s), or times in a first column")
    elevation = values[:, place] * (unit_of(path, names[place], "length") if names else 1.0)
    if timed:
        clock = unit_of(path, names[0], "time") if names else 1.0
        return Record(elevation, *(clock * part for part in _even_steps(path, values[:, 0], lines)))
    return Record(elevation, positive("step", step, "s"))


def components_of(record, direction, shortest=0.0):
    """`sea.Components` whose sum is the record without its mean, by a Fourier series over the length of the record.

    direction : direction of travel of all waves, rad; shortest : period below which waves are omitted, s. Time is
        counted from the first value; after the last value the record repeats.
    """
    from .sea import Components

    n = len(record.elevation)
    X = 2 / n * np.fft.rfft(record.elevation - np.mean(record.elevation))
    omega = 2 * np.pi * np.fft.rfftfreq(n, record.step)
    longest = 2 * np.pi / shortest if shortest > 0 else np.inf
    kept = (omega > 0) & (omega <= longest) & (np.abs(X) > FAINT * np.abs(X).max())
    if n % 2 == 0:
        kept[-1] = False  # phase and amplitude cannot be separated at half the sampling rate
    return Components(omega[kept], np.abs(X[kept]), -np.angle(X[kept]), np.full(np.count_nonzero(kept), direction))


def _even_steps(path, t, lines):
    t = without_rounding(t)
    step = (t[-1] - t[0]) / (len(t) - 1)
    off = np.abs(t - (t[0] + step * np.arange(len(t))))
    if not step > 0 or off.max() > UNEVEN * step:
        raise fault_of_steps(path, t, UNEVEN, lines)
    return float(step), float(t[0])
