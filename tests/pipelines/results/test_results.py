"""Views of a result: each has the same numbers."""

import csv
import io
import json

import numpy as np
import pytest

from hakobune.bem.database.integrity import DatabaseError, VersionError
from hakobune.pipelines.results.file import read
from hakobune.pipelines.results.quantity import Quantity, quantities, read_in
from hakobune.pipelines.results.result import Result, labels
from hakobune.pipelines.results.tables import printed, tables
from hakobune.pipelines.results.writing import write

ODD = np.nextafter(0.1, 1) * np.array([1.0, 3e4, 7e-5])  # no number of few digits


def example(findings=("FAILS: a parts, 120 %, limit 100 %", "b lies"), first=("left out: c",)):
    motion = ("m", "m", "rad")
    return Result(
        "example",
        {
            "motion.sigma": Quantity(ODD, ("motion",), motion, "σ", "motions"),
            "motion.period": Quantity([8.25, np.nan, np.inf], ("motion",), "s", "period", "motions"),
            "tension.largest": Quantity([13.25, 7e-3], ("line",), "N", "largest", "lines"),
            "tension.used": Quantity([0.25, 0.75], ("line",), "", "used", "lines", share=True),
            "tension.place": Quantity(np.arange(6.0).reshape(2, 3) / 3, ("line", "xyz"), "m", "place"),
            "energy": Quantity(13.2, (), "J", "energy", "ship"),
            "count": Quantity(3, (), "", "fenders", "ship"),
            "name": Quantity("soft, α", (), "", "fender", "ship"),
            "rao": Quantity(np.array([1 + 2j, 0.5j]), ("line",), "m/m", "response"),
            "record": Quantity(np.arange(4.0), ("time",), "m", "a record", record=True),
        },
        {
            **labels("motion", ["surge", "sway", "yaw"]),
            **labels("line", ["fore, port", "aft"]),
            **labels("xyz", ["x", "y", "z"]),
            **labels("time", [0.0, 0.5, 1.0, 1.5], "s"),
        },
        findings,
        ("a note",),
        first,
        {"study": "a = 1\n"},
    )


def test_a_result_that_is_read_back_equals_the_one_that_was_written(tmp_path):
    example().write(tmp_path / "a.h5")
    back = read(tmp_path / "a.h5")
    assert back == example() and back.kind == "example" and back.status == 1
    assert back != example(findings=())
    with pytest.raises(DatabaseError, match="a file of example, and not a file of other"):
        read(tmp_path / "a.h5", "other")


def test_xarray_reads_the_file_with_its_axes_and_units(tmp_path):
    import xarray

    example().write(tmp_path / "a.h5")
    with xarray.open_dataset(tmp_path / "a.h5", engine="h5netcdf") as data:
        assert data["tension.largest"].sel(line="aft") == 7e-3 and data["tension.largest"].units == "N"
        assert data["tension.place"].dims == ("line", "xyz") and list(data.motion) == ["surge", "sway", "yaw"]
    made = example().to_xarray()
    assert made["motion.sigma"].sel(motion="yaw") == ODD[2] and made["energy"].units == "J"


def test_csv_and_json_have_every_number_to_the_bit():
    made = example()
    document = json.loads(made.to_json())
    kept = {name: one for name, one in made.quantities.items() if not one.record}
    assert document["quantities"].keys() == kept.keys()
    for name, one in kept.items():
        values = document["quantities"][name]["values"]
        if one.values.dtype.kind == "f":
            assert np.array_equal(np.array(values, float), np.where(np.isfinite(one.values), one.values, np.nan), True)
    assert document["quantities"]["rao"]["values"] == [[1, 2], [0, 0.5]]
    assert document["findings"][1] == {"fails": True, "text": "a parts, 120 %, limit 100 %"}
    blocks = [list(csv.reader(io.StringIO(block))) for block in made.to_csv().strip().split("\n\n")]
    cells = {name: [row[k] for row in rows[1:]] for rows in blocks for k, name in enumerate(rows[0])}
    assert [float(cell) for cell in cells["motion.sigma"]] == ODD.tolist()
    assert [["quantity", "value", "unit"], ["energy", "13.2", "J"]] in [rows[:2] for rows in blocks]
    assert cells["unit"] == ["J", "", ""]
    assert [float(cell) for cell in cells["tension.place[y] [m]"]] == [1 / 3, 4 / 3]
    assert cells["motion.period [s]"] == ["8.25", "", ""]


def test_a_print_has_significant_digits_in_the_unit_that_suits_the_numbers(capsys):
    """13 N are printed as 13 N, 13 kN as kN; a share in per cent; what a default leaves out comes first"""
    assert printed(example()) == 1
    out = capsys.readouterr().out
    assert "largest, N" in out and "13.25" in out and "0.007" in out and "75" in out
    assert out.index("left out: c") < out.index("motions") < out.index("a note") < out.index("FAILS: a parts")
    headings = [column.heading for one in tables(example(), True) for column in one.columns]
    assert [one for one in headings if one.startswith("place")] == ["place x", "place y", "place z"]
    assert read_in("N", np.array([999.0])) == ("N", 1.0) and read_in("N", np.array([1e3])) == ("kN", 1e3)
    assert read_in("rad", np.array([np.pi])) == ("°", np.pi / 180)


def test_forces_of_one_table_are_read_in_one_unit(capsys):
    columns = quantities("pull", {"Fx": ([5e4, 1e3], "N", "Fx"), "Fy": ([634.2, 2.0], "N", "Fy")}, "line")
    printed(Result("example", columns, labels("line", ["one", "two"])))
    out = capsys.readouterr().out
    assert "Fy, kN" in out and "0.6342" in out and "0.002" in out


def test_rounding_beside_large_forces_is_printed_as_nothing(capsys):
    force = Quantity([5e6, 4e-10], ("line",), "N", "pull", "lines")
    printed(Result("example", {"a": force}, labels("line", ["one", "two"])))
    assert capsys.readouterr().out.split("two")[1].split()[1] == "0"


def test_a_row_has_one_unit_in_all_columns(capsys):
    """1200 N and 900 N of one row are 1.2 and 0.9 kN"""
    given = {"a": ([1200.0, 3.0], ("N", "m"), "a"), "b": ([900.0, 4.0], ("N", "m"), "b")}
    printed(Result("example", quantities("drift", given, "motion"), labels("motion", ["surge", "sway"])))
    row = next(line for line in capsys.readouterr().out.splitlines() if "surge" in line)
    assert [cell.strip() for cell in row.split("│")[1:-1]] == ["surge, kN", "1.2", "0.9"]


def test_of_a_long_table_over_numbers_some_rows_are_printed_and_all_are_in_csv(capsys):
    made = Result(
        "example", quantities("K", {"k": (np.arange(60.0), "", "k")}, "period"), labels("period", np.arange(60.0))
    )
    printed(made)
    shown = capsys.readouterr().out
    assert "12 of 60 rows" in " ".join(shown.split()) and sum(line.startswith("│") for line in shown.splitlines()) == 12
    assert len(made.to_csv().strip().splitlines()) == 61


def test_a_table_of_few_rows_and_many_columns_is_printed_turned_without_shares_of_nothing(capsys):
    given = {name: ([2e3], "N", name) for name in ("mean", "largest", "least")} | {"used": ([np.nan], "%", "used")}
    printed(Result("example", quantities("tension", given, "line"), labels("line", ["bow"])))
    cells = [[c.strip() for c in line.split("│")[1:-1]] for line in capsys.readouterr().out.splitlines() if "│" in line]
    assert cells == [["mean", "2", "kN"], ["largest", "2", "kN"], ["least", "2", "kN"]]


@pytest.mark.parametrize("rows", [2, 3, 8])
def test_a_table_of_many_columns_and_a_long_text_are_within_80_characters(rows, capsys):
    """14 characters of a heading and 3 beside it, eight times, would be 137"""
    given = {f"largest {name}": (np.full(rows, -1234.5), "N", f"largest {name}") for name in "abcdefg"}
    words = quantities("texts", {"size": (["a long size of an anchor " * 4] * rows, "", "size")}, "line")
    printed(Result("example", quantities("forces", given, "line") | words, labels("line", np.arange(rows).astype(str))))
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 80 and sum(line.count("-1.23") for line in lines) == 7 * rows
    assert " ".join(lines).count("anchor") == 4 * rows


def test_a_quantity_is_found_by_its_name_and_the_label_of_its_axis():
    made = example()
    assert made["tension[aft].largest"] == 7e-3 and np.array_equal(made["tension[*].largest"], made["tension.largest"])
    assert made.quantity("motion[yaw].sigma").unit == "rad" and len(made) == 10
    assert made["yaw.sigma"] == ODD[2] and made["aft.largest"] == 7e-3
    with pytest.raises(KeyError, match="'bow' is not among the line labels"):
        made["tension[bow].largest"]
    with pytest.raises(KeyError, match="is not a quantity of this result; allowed"):
        made["tensions"]


def test_values_without_as_many_labels_are_refused():
    with pytest.raises(ValueError, match="has 2 values on the axis 'line'"):
        Result("example", {"a": Quantity([1.0, 2.0], ("line",))}, labels("line", ["one"]))
    with pytest.raises(ValueError, match="'line' names both a quantity and an axis"):
        Result("example", {"line": Quantity([1.0], ("line",))}, labels("line", ["one"]))
    with pytest.raises(ValueError, match="values have 2 axes, and 1 axes are named"):
        Quantity(np.zeros((2, 2)), ("line",))


def test_a_data_frame_has_the_labels_as_its_index():
    frame = example().to_dataframe("tension.largest", "tension.used")
    assert frame.loc["aft", "tension.used"] == 0.75 and frame.index.name == "line"
    with pytest.raises(
        ValueError, match="do not share a single axis; allowed: quantities that all have the same single axis"
    ):
        example().to_dataframe("tension.largest", "motion.sigma")
    assert "<td>fore, port</td>" in example()._repr_html_() and "FAILS: a parts" in example()._repr_html_()


def test_a_file_of_version_1_names_the_command_that_makes_it_again(tmp_path):
    from hakobune.bem.database.file import beside

    with beside(tmp_path / "old.h5") as file:
        file.attrs["schema"] = "hakobune mooring study 1"
    with pytest.raises(VersionError, match="hakobune moor STUDY --database DATABASE"):
        read(tmp_path / "old.h5", "moor")


def test_a_file_of_version_1_that_cannot_be_opened_is_told_as_that(tmp_path):
    """Cut short, and without a seal: the attribute is still there among its bytes"""
    (tmp_path / "cut.h5").write_bytes(b"\x89HDF\r\n\x1a\nschema hakobune mooring study 1\0")
    with pytest.raises(VersionError, match=r"is a file of mooring study of schema version 1, and this program reads"):
        read(tmp_path / "cut.h5", "moor")


@pytest.mark.parametrize("words", ["# hakobune mooring study 1", "hakobune moor 99, or hakobune mooring study 2"])
def test_an_intact_result_whose_study_has_the_words_of_another_version_is_read(tmp_path, words):
    made = Result("moor", {"a": Quantity(2.0)}, {}, provenance={"study": words})
    write(made, tmp_path / "new.h5")
    for kind in (None, "moor"):
        found = read(tmp_path / "new.h5", kind)
        assert found["a"] == 2.0 and found.provenance["study"] == words


def test_quantities_are_equal_if_their_values_and_all_their_words_are():
    one = Quantity([1.0, np.nan], ("line",), "N", "largest", "lines")
    assert one == Quantity([1.0, np.nan], ("line",), "N", "largest", "lines") and one != [1.0, np.nan]
    for values in ([1.0, 2.0], [1.5, np.nan], [np.nan, 1.0]):
        assert one != Quantity(values, ("line",), "N", "largest", "lines")
    for words in (("leg", "N", "largest", "lines"), ("line", "kN", "largest", "lines"), ("line", "N", "l", "lines"),
                  ("line", "N", "largest", "")):  # fmt: skip
        assert one != Quantity([1.0, np.nan], words[:1], *words[1:])
    assert Quantity(["a", "b"], ("line",)) != Quantity(["a", "c"], ("line",)) == Quantity(["a", "c"], ("line",))
