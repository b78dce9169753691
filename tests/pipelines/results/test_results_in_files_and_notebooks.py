"""A result as records, data frames and a page: names, units, axes and what is refused, of numbers that are made up."""

import sys

import numpy as np
import pytest

from hakobune.pipelines.results import frames, records, tables
from hakobune.pipelines.results.quantity import Quantity
from hakobune.pipelines.results.result import Result, labels


@pytest.fixture
def result():
    """Two lines and a course of three samples"""
    made = {
        "tension.largest": Quantity(np.array([2e5, 3e5]), ("line",), "N", "largest", "lines <a>"),
        "tension.used": Quantity(np.array([0.2, 0.3]), ("line",), "", "used", "lines <a>"),
        "count": Quantity(np.array(2.0), (), "m", "count"), "depth": Quantity(np.array(20.0), (), "m", "depth"),
        "both": Quantity(np.zeros((2, 3)), ("line", "time"), ("N", "m"), "both"),
        "course.x": Quantity(np.array([1.0, 1.5, 2.0]), ("time",), "m", "x", record=True),
        "course.pull": Quantity(np.array([[1.0, 2], [3, 4], [5, 6]]), ("time", "line"), "N", "pull", record=True),
        "other.x": Quantity(np.array([9.0, 9.5]), ("line",), "m", "x", record=True),
    }  # fmt: skip
    axes = labels("line", ["bow", "stern"]) | labels("time", [0.0, 0.1, 0.2], "s")
    return Result("moor", made, axes, ("FAILS: it <tilts>",), ("a note & more",), (), {"study": "text"})


def test_records_of_an_axis_are_a_table_with_units_in_its_head(result, tmp_path):
    path = tmp_path / "r.csv"
    records.write_records(result, path)
    lines = path.read_text().splitlines()
    assert lines[0] == "# hakobune moor, records"
    head = lines[1].split(",")
    assert head[0] == "time [s]" and head[1] == "course.x [m]" and len(head) == 4
    assert all(name.endswith("[N]") and word in name for name, word in zip(head[2:], ("bow", "stern"), strict=True))
    assert [list(map(float, line.split(","))) for line in lines[2:]] == [[0, 1, 1, 2], [0.1, 1.5, 3, 4], [0.2, 2, 5, 6]]


@pytest.mark.parametrize("name, whole", [("r.h5", True), ("r.HDF5", True), ("r.csv", False)])
def test_a_name_of_hdf5_has_the_whole_result(result, tmp_path, monkeypatch, name, whole):
    wrote = []
    monkeypatch.setattr(Result, "write", lambda self, path: wrote.append(path))
    records.write_records(result, tmp_path / name)
    assert wrote == [tmp_path / name] * whole and (tmp_path / name).exists() is not whole


def test_a_data_set_has_every_quantity_with_its_unit_and_the_origin(result):
    pytest.importorskip("xarray")
    made = frames.as_xarray(result)
    assert set(made.data_vars) == set(result.quantities) and made["tension.largest"].values.tolist() == [2e5, 3e5]
    assert made["tension.largest"].attrs == {"units": "N", "long_name": "largest"} and made["both"].dims == (
        "line",
        "time",
    )
    assert made["both"].attrs["units"] == "N, m" and made.coords["time"].attrs["units"] == "s"
    assert made.coords["line"].values.tolist() == ["bow", "stern"]
    assert (
        made.attrs["kind"] == "moor" and made.attrs["study"] == "text" and made.attrs["findings"] == list(result.told)
    )


def test_a_frame_has_quantities_of_one_axis_by_default_of_the_first_table(result):
    pytest.importorskip("pandas")
    made = frames.as_dataframe(result)
    assert list(made.columns) == ["tension.largest", "tension.used"] and made.index.name == "line"
    assert made.index.tolist() == ["bow", "stern"] and made["tension.used"].tolist() == [0.2, 0.3]
    made = frames.as_dataframe(result, "depth", "count")
    assert made.to_dict("list") == {"depth": [20.0], "count": [2.0]}
    made = frames.as_dataframe(result, "course.x")
    assert made.index.tolist() == [0.0, 0.1, 0.2] and made["course.x"].tolist() == [1.0, 1.5, 2.0]
    for names in (("tension.largest", "course.x"), ("both",), ("depth", "course.x")):
        with pytest.raises(ValueError) as refused:
            frames.as_dataframe(result, *names)
        assert str(refused.value).startswith(
            f"{', '.join(names)} do not share a single axis; allowed: quantities that all"
        )
    with pytest.raises(KeyError):
        frames.as_dataframe(result, "unknown")


@pytest.mark.parametrize("call, package", [(frames.as_xarray, "xarray"), (frames.as_dataframe, "pandas")])
def test_a_library_that_is_not_there_is_named_with_its_way_out(result, monkeypatch, call, package):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=rf"{package} is not installed; install hakobune\[xarray\]"):
        call(result)


def test_a_page_has_tables_in_units_of_print_and_no_marks_of_its_own(result):
    page = frames.as_html(result)
    assert page.startswith("<h4>moor</h4><table><caption>lines &lt;a&gt;")
    assert "<td>bow</td><td>200" in page and "<td>stern</td><td>300" in page and "kN" in page
    assert page.index("<p>a note &amp; more</p>") < page.index("<p>FAILS: it &lt;tilts&gt;</p>") and page.endswith(
        "</p>"
    )
    assert page.count("<tr>") == 3 and page.count("<th>") == page.split("</tr>")[1].count("<td>")


def test_rows_of_their_own_units_have_them_beside_their_names_and_columns_of_one_unit_in_the_head():
    """A force of 2 kN and a moment of 3 kN m at 4 and 5 m"""
    made = {
        "held.load": Quantity(np.array([2e3, 3e3]), ("part",), ("N", "N m"), "load", "held"),
        "held.at": Quantity(np.array([4.0, 5.0]), ("part",), "m", "at", "held"),
    }
    result = Result("x", made, labels("part", ["force", "moment"]))
    (shown,) = tables.tables(result)
    table = tables.rich_table(shown, result.labels)
    first, load, at = ([str(cell) for cell in column.cells] for column in table.columns)
    assert first == ["force, kN", "moment, kN m"] and [float(cell) for cell in load] == [2.0, 3.0]
    assert [float(cell) for cell in at] == [4.0, 5.0]
    heads = [str(column.header) for column in table.columns]
    assert "kN" not in heads[1] and "load" in heads[1] and "at" in heads[2] and "m" in heads[2]
