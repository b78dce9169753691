"""Random damage to stored files is refused or changes nothing; the campaign is tests/fuzz/databases.py."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[2] / "fuzz"))

from databases import campaign, make_files


def test_no_damage_to_a_database_or_a_result_is_believed(tmp_path):
    counts = campaign(make_files(tmp_path), 100, seed=3)
    assert counts["believed"] == counts["crashed"] == 0, counts
    assert counts["refused"] > 50
