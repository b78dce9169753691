"""Quantities of the cases of a sweep lie on named axes in its file."""

import h5py
import numpy as np

from hakobune.bem.database.schema import LABELS
from hakobune.pipelines.results.quantity import Quantity
from hakobune.pipelines.sweep.file import _store, case_count, create, pending


def test_every_axis_of_a_quantity_has_its_scale_and_cases_of_another_shape_are_left_out(tmp_path):
    with h5py.File(tmp_path / "sweep.h5", "w") as file:
        file.create_dataset("case", data=np.arange(2)).make_scale("case")
        axes = ("omega", "influenced_dof", "xyz")
        known = {axis: Quantity(np.array(LABELS[axis]), (axis,)) for axis in axes[1:]}
        first = np.arange(4 * 6 * 3.0).reshape(4, 6, 3)

        def store(case, values):
            return _store(file, "force", case, Quantity(values, axes, "N"), known)

        assert store(0, first) == "" and store(1, first + 1) == ""
        data = file["results/force"]
        names = [dim[0].name.split("/")[-1] for dim in data.dims]
        assert names == ["case", *axes] and data.attrs["units"] == "N"
        assert file["results/axes/xyz"].asstr()[()].tolist() == ["x", "y", "z"]
        assert file["results/axes/influenced_dof"].asstr()[0] == "Surge"
        assert file["results/axes/omega"][()].tolist() == [0, 1, 2, 3]
        assert np.array_equal(data[()], [first, first + 1])
        said = store(1, first[:2])
        assert (
            said.startswith("force has the shape (2, 6, 3) here and (4, 6, 3) in the first case")
            and data[1, 0, 0, 0] == 1
        )


def test_a_new_file_has_its_cases_as_the_axis_of_all_that_is_in_it(tmp_path):
    """Numbers as numbers, words as words, every case still to do; readers of netCDF find the axis by its scale"""
    path = tmp_path / "sweep.h5"
    create(path, ["beam", "waves.kind"], [(10.0, "jonswap"), (12, "issc"), (14.0, "tma")], {"sweep": "text"})
    assert pending(path) == [0, 1, 2] and case_count(path) == 3
    with h5py.File(path) as file:
        assert file["keys/beam"][()].tolist() == [10.0, 12.0, 14.0] and file["message"].asstr()[()].tolist() == [""] * 3
        assert file["keys/waves.kind"].asstr()[()].tolist() == ["jonswap", "issc", "tma"]
        assert file.attrs["sweep"] == "text" and file["case"][()].tolist() == [0, 1, 2]
        for name in ("keys/beam", "keys/waves.kind", "status", "message"):
            assert [scale.name for scale in file[name].dims[0].values()] == ["/case"], name
