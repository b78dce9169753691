"""Widening of a database by frequencies, headings and quantities: a new file gets the rows of the old file.

The new file is made beside the old file and renamed when complete, so that a run can be killed at any instant.  Groups
outside the grid over frequencies are written whole and sealed with the file, and are kept when the file is widened.
The attribute `axes` of a dataset in a group names the axes of the dataset.
"""

import numpy as np

from .file import LATER, DatabaseError, beside, lay_out, read_header
from .integrity import ROWS, has_checksums, remark, row_crcs
from .rows import estimate_of, mark_whole_rows, places_on, same_heading, same_omega, writing
from .schema import CELL_AXES, CHECKS, QUANTITIES

GROUPS = ("qtf", "qtf_sum")


def extend(path, *, omega=(), wave_direction=(), names=(), header=None, anew=()):
    """Widen a file by frequencies, headings and quantities; its contents are kept, and the added numbers are pending.

    header : header that replaces the stored one, if something is added or the `scene_hash` of the two differs
    anew : names of quantities whose stored values are dropped
    Returns whether anything was added. If so, `path` names a new file, and a file that was open remains the old file.
    """
    with writing(path) as old:
        kept = read_header(old)
        header = header or kept
        stored = [name for name in QUANTITIES if name in old]
        wider_omega = _union(old["omega"][()], omega, same_omega)
        wider_heading = _union(old["wave_direction"][()], wave_direction, same_heading)
        wider = [name for name in QUANTITIES if name in stored or name in names]
        grown = (
            len(wider_omega) > len(old["omega"])
            or len(wider_heading) > len(old["wave_direction"])
            or len(wider) > len(stored)
            or header.scene_hash != kept.scene_hash
            or len(header.theta) != len(kept.theta)
        )
        if grown:
            with beside(old.filename, LATER) as file:
                lay_out(file, header, wider_omega, wider_heading, wider)
                take_over(old, file, anew)
                if header.scene_hash == kept.scene_hash and not anew:
                    for name in (name for name in GROUPS if name in old):
                        fill(file, name, *content(old, name))
    return grown


def write_group(path, name, datasets, attributes):
    """Write a group to a database and replace a group of the same name; a new file is written and renamed when
    complete.  Arguments as in `fill`.
    """
    with writing(path) as old, beside(old.filename, LATER) as file:
        quantities = [quantity for quantity in QUANTITIES if quantity in old]
        lay_out(file, read_header(old), old["omega"][()], old["wave_direction"][()], quantities)
        take_over(old, file)
        for other in (other for other in GROUPS if other in old and other != name):
            fill(file, other, *content(old, other))
        fill(file, name, datasets, attributes)


def take_over(old, new, anew=()):
    """Copy numbers and marks of quantities not in `anew`, checks and wall times to their places in a wider file."""
    i = places_on(new, old["omega"], "omega")
    j = places_on(new, old["wave_direction"], "wave_direction")
    for name in (name for name in QUANTITIES if name in old and name not in anew):
        axes = CELL_AXES[name]
        carried = old[name].shape[-1:] != new[name].shape[-1:] and QUANTITIES[name][0][-1] == "theta"
        for path in (p for p in (name, f"stored/{name}", estimate_of(name)) if p in old and p in new):
            value = np.asarray(new[path])
            there = old[path][()]
            if path == name and carried:
                there = at_angles(there, value.shape[-1])
            value[np.ix_(i, j) if len(axes) == 2 else (i if axes else ...)] = there
            new[path][...] = value
        kinds = [file[estimate_of(name)].dtype if estimate_of(name) in file else None for file in (old, new)]
        if carried or not has_checksums(old) or kinds[0] != kinds[1]:
            remark(new, name)
    for path in (*(f"checks/{name}" for name in CHECKS), "wall_time"):
        value = new[path][()]
        value[i] = old[path][()]
        new[path][...] = value
    mark_whole_rows(new)
    sums, found = new[ROWS][()], row_crcs(new)
    sums[i] = np.array(found, sums.dtype)[i]
    new[ROWS][...] = sums


def at_angles(values, count):
    """Kochin functions (…, count) at more evenly spaced angles, from values (…, t) at angles that resolve them

    At angles that resolve them, Kochin functions are trigonometric polynomials to the last digits, and the Fourier
    series gives their values at any angle.
    """
    series = np.fft.fft(values, axis=-1)
    half, out = values.shape[-1] // 2, np.zeros((*values.shape[:-1], count), complex)
    up = values.shape[-1] - half
    out[..., :up], out[..., count - half :] = series[..., :up], series[..., up:]
    return np.fft.ifft(out, axis=-1) * (count / values.shape[-1])


def _union(old, new, same):
    added = [float(b) for b in new if not any(same(a, b) for a in old)]
    return np.unique(np.concatenate([old, added]))


def fill(file, name, datasets, attributes):
    """Write a group to an open file and replace a group of the same name.

    datasets : {name: (axes, unit, values)}, with the datasets of axes first; attributes : attributes of the group
    """
    if name in file:
        del file[name]
    group = file.create_group(name)
    group.attrs.update(attributes)
    for key, (axes, unit, values) in datasets.items():
        dataset = group.create_dataset(key, data=values)
        dataset.attrs["axes"] = " ".join(axes)
        if unit:
            dataset.attrs["units"] = unit
        if axes == (key,):
            dataset.make_scale(key)
        else:
            for place, axis in enumerate(axes):
                dataset.dims[place].attach_scale(group[axis])


def read_group(db, name):
    """{dataset: (axes, unit, values)} and attributes of a group of an opened `Database`, or None if it has no such
    group"""
    with db.opened() as file:
        return content(file, name)


def content(file, name):
    """`read_group` of an open file.  Raises DatabaseError"""
    if name not in file:
        return None
    group = file[name]
    try:
        datasets = {
            key: (tuple(part.attrs["axes"].split()), str(part.attrs.get("units", "")), part[()])
            for key, part in group.items()
        }
    except KeyError as error:
        raise DatabaseError(
            f"{file.filename} is damaged: {name}: {error.args[0]}; compute this group of results again"
        ) from None
    scales = {key: part for key, part in datasets.items() if part[0] == (key,)}
    return {**scales, **datasets}, dict(group.attrs)
