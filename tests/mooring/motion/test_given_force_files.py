"""Files of forces in time: columns by their names, gaps told with their line."""

import re

import numpy as np
import pytest

from hakobune.mooring.environment.tables import TableError
from hakobune.mooring.motion.given_forces import read_force

NAMES = "t,Fx,Fy,Fz,Mx,My,Mz"
ROWS = [f"{t},1,2,3,4,5,6" for t in range(60)]


def written(path, rows, names=NAMES):
    path.write_text("\n".join([names, *rows]) + "\n")
    return path


def test_columns_are_taken_by_their_names(tmp_path):
    made = read_force(written(tmp_path / "f.csv", ROWS, "t,Fy,Fx,Fz,Mx,My,Mz"))
    assert np.all(made.force == [2, 1, 3, 4, 5, 6]) and np.all(made.times == np.arange(60))


def test_a_long_gap_is_warned_of_with_its_line(tmp_path):
    with pytest.warns(UserWarning, match=re.escape("f.csv: line 11: no force is given from 8 to 40 s")):
        read_force(written(tmp_path / "f.csv", ROWS[:9] + ROWS[40:]))


@pytest.mark.parametrize(
    "rows, names, says",
    [
        (ROWS[:5] + ROWS[4:], NAMES, "line 7: the time stays at 4 s"),
        (
            ROWS[:5] + ["5,1,nan,3,4,5,6"] + ROWS[6:],
            NAMES,
            "line 7 has 'nan'; allowed: finite numbers; fill in the value",
        ),
        (ROWS[1:], ROWS[0], "no column names in its first row"),
        (ROWS, NAMES.replace("Mz", "Nz"), "allowed: t, Fx, Fy, Fz, Mx, My, Mz"),
        (ROWS[:1], NAMES, "has one row"),
        ([], NAMES, "no rows of numbers"),
    ],
)
def test_a_file_that_is_no_force_is_told_in_one_line(tmp_path, rows, names, says):
    with pytest.raises(TableError, match=re.escape(says)) as caught:
        read_force(written(tmp_path / "f.csv", rows, names))
    assert "f.csv" in str(caught.value) and "\n" not in str(caught.value)
