"""A small real database, solved once: the series box with 60 panels, and its Reader."""

import pytest

from hakobune.bem.database import open_database
from hakobune.pipelines.cli import main

WORDS = "box --length 100 --beam 50 --draft 10 --depth 20 --panels 60 --gyration 15.55,29.44,32.28"


@pytest.fixture(scope="session")
def box_path(tmp_path_factory):
    path = tmp_path_factory.mktemp("response") / "box.h5"
    words = [*WORDS.split(), "--omega", "0.25:1.05:17", "--heading", "0,22.5,45,67.5,90", "--output", str(path)]
    assert main(words) == 0
    return path


@pytest.fixture(scope="session")
def box_database(box_path):
    return open_database(box_path)


@pytest.fixture(scope="session")
def box_body(box_database):
    return box_database.reader.floating()
