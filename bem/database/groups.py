"""Groups of a database beside its grid over frequencies: written whole, sealed with the file, kept while it is widened.

A group has datasets with axes of its own; the names of a dataset's axes are its attribute `axes`.
"""

from __future__ import annotations

from .file import DatabaseError

GROUPS = ("qtf",)


def fill(file, name, datasets, attributes):
    """Put a group into an open file, in place of one of that name.

    datasets : {name: (axes, unit, values)}, the axes first; attributes : of the group
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
    """{dataset: (axes, unit, values)} and attributes of a group of an opened `Database`, or None where it has none"""
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
        raise DatabaseError(f"{file.filename} is damaged: {name}: {error.args[0]}; make the group anew") from None
    scales = {key: part for key, part in datasets.items() if part[0] == (key,)}
    return {**scales, **datasets}, dict(group.attrs)
