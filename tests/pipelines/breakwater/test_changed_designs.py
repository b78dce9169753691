"""What an optimisation changes of a breakwater, by hand."""

import numpy as np
import pytest

from hakobune.pipelines.breakwater.build import breakwater_of
from hakobune.pipelines.breakwater.study import MOST_OBLIQUE, read_breakwater
from hakobune.pipelines.common.quantities import StudyError

TEXT = """
holdings = ["taut"]
[water]
depth = 12.0
[section]
shape = "rectangle"
beam = 10.0
height = 6.0
draft = 4.0
[body]
mass_t_per_m = 30.0
center_of_gravity = 3.0
gyration = 4.0
[lines]
angle_deg = 45.0
attachment = 5.0
attachment_height = 1.0
[waves]
height = 1.0
periods = [6.0]
"""


def test_a_wider_and_deeper_rectangle_is_the_same_body_stretched_across_and_upright(tmp_path):
    """A stretch of 1.2 across and 1.5 upright takes the area, and so the mass of the same material, times 1.8; heights
    above the keel go with 1.5, what is measured across with 1.2."""
    path = tmp_path / "study.toml"
    path.write_text(TEXT)
    made = breakwater_of(read_breakwater(path)[0]).changed(draft=6.0, width=12.0, angle=np.radians(60.0))
    assert (made.section.beam, made.section.height, made.section.draft) == pytest.approx((12.0, 9.0, 6.0))
    assert made.body.mass == pytest.approx(54e3)
    assert (made.body.center_of_gravity, made.body.gyration) == pytest.approx((4.5, 4.8))
    assert (made.lines.attachment, made.lines.attachment_height) == pytest.approx((6.0, 1.5))
    assert made.lines.angle == pytest.approx(np.pi / 3)
    path.write_text(TEXT.replace("mass_t_per_m = 30.0", "free_draft = 3.0"))
    asked = breakwater_of(read_breakwater(path)[0])
    assert asked.changed(draft=6.0).body.free_draft == pytest.approx(4.5)
    same = asked.changed(angle=np.radians(50.0))
    assert (same.section, same.body) == (asked.section, asked.body)


@pytest.mark.parametrize("key", ["waves", "sea"])
@pytest.mark.parametrize("degrees, refused", [(MOST_OBLIQUE - 1, False), (MOST_OBLIQUE + 1, True), (-90, True)])
def test_waves_and_sea_come_within_the_obliquity_that_is_solved(key, degrees, refused, tmp_path):
    path = tmp_path / "study.toml"
    sea = "[sea]\nspectrum = 'bretschneider'\nheight = 1.0\nsignificant_period = 6.0\n"
    text = TEXT.replace('holdings = ["taut"]', 'holdings = ["fixed"]') + sea
    path.write_text(text.replace(f"[{key}]", f"[{key}]\nobliquity_deg = {degrees}"))
    if refused:
        with pytest.raises(StudyError, match=rf"{key}.obliquity_deg is {degrees}; allowed: -{MOST_OBLIQUE} to"):
            read_breakwater(path)
    else:
        assert getattr(read_breakwater(path)[0], key).obliquity_deg == degrees
