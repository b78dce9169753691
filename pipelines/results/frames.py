"""A result in notebooks: xarray, pandas, and a page of tables."""

import html

from .tables import rich_table, tables


def as_xarray(result):
    """xarray.Dataset. Raises ImportError, whose message names the remedy."""
    try:
        import xarray
    except ImportError:
        raise ImportError("xarray is not installed; install hakobune[xarray]") from None

    made = {}
    for name, one in result.quantities.items():
        unit = ", ".join(one.unit) if isinstance(one.unit, tuple) else one.unit
        made[name] = xarray.DataArray(one.values, dims=one.axes, attrs={"units": unit, "long_name": one.description})
    axes = {axis: (axis, one.values, {"units": one.unit}) for axis, one in result.labels.items()}
    return xarray.Dataset(made, axes, {"kind": result.kind, "findings": list(result.told), **result.provenance})


def as_dataframe(result, *names):
    """pandas.DataFrame of quantities on one axis, or of all without axes; by default of the first table.

    raises : ValueError for different axes, KeyError for an unknown name, ImportError without pandas
    """
    try:
        import pandas
    except ImportError:
        raise ImportError("pandas is not installed; install hakobune[xarray]") from None
    names = names or tuple(dict.fromkeys(column.name.partition("[")[0] for column in tables(result)[0].columns))
    found = [result.quantity(name) for name in names]
    axes = {one.axes for one in found}
    if len(axes) > 1 or len(found[0].axes) > 1:
        raise ValueError(
            f"{', '.join(names)} do not share a single axis; allowed: quantities that all have the same single axis"
        )
    if not found[0].axes:
        return pandas.DataFrame({name: [one.values[()]] for name, one in zip(names, found, strict=True)})
    axis = found[0].axes[0]
    index = pandas.Index(result.labels[axis].values, name=axis)
    return pandas.DataFrame({name: one.values for name, one in zip(names, found, strict=True)}, index)


def as_html(result):
    """Tables of a result as HTML, in print units, and its findings"""
    parts = [f"<h4>{html.escape(result.kind)}</h4>"]
    for shown in tables(result):
        table = rich_table(shown, result.labels)
        head = "".join(f"<th>{html.escape(str(column.header))}</th>" for column in table.columns)
        cells = zip(*(list(column.cells) for column in table.columns), strict=True)
        rows = "".join("<tr>" + "".join(f"<td>{html.escape(str(c))}</td>" for c in row) + "</tr>" for row in cells)
        title = f"<caption>{html.escape(shown.title)}</caption>"
        parts.append(f"<table>{title}<thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>")
    parts += [f"<p>{html.escape(line)}</p>" for line in (*result.notes, *result.told)]
    return "".join(parts)
