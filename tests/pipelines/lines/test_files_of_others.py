"""`hakobune lines` takes files of other programs by their suffix, and a fault in one names the file."""

import pytest

from hakobune.mooring.formats.fault import FormatError
from hakobune.pipelines.lines.system_file import _read

MOORPY = """\
water_depth: 200
line_types:
  - {name: chain, diameter: 0.151, mass_density: 141, stiffness: 6.0e8}
points:
  - {name: anchor, type: fixed, location: [-800, 0, -200]}
  - {name: fair, type: vessel, location: [-20, 0, -14]}
lines:
  - {name: leg, endA: anchor, endB: fair, type: chain, length: 850}
"""


@pytest.mark.parametrize("suffix", [".yaml", ".yml"])
def test_a_system_of_moorpy_is_read_with_its_text(tmp_path, suffix):
    path = tmp_path / f"leg{suffix}"
    path.write_text(MOORPY)
    system, text, moordyn = _read(path, None)
    assert (system.depth, text, moordyn) == (200.0, MOORPY, None)
    assert [(line.name, line.length) for line in system.lines] == [("leg", 850.0)]
    path.write_text(MOORPY.replace("lines:", "lines"))
    with pytest.raises(FormatError, match=r"leg\.ya?ml"):
        _read(path, None)
