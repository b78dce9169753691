"""One database of the series box for all tests of bodies in time, and its mooring of twelve chains."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from two_bodies import coupled_bodies

from hakobune import pipelines
from hakobune.bem.database import open_database
from hakobune.mooring.lines.catalogue import line_type
from hakobune.mooring.lines.system.moored_body import corner_legs, moored_body
from hakobune.mooring.lines.system.parts import UniformLine
from hakobune.mooring.motion.simulation import moored
from hakobune.mooring.motion.wave_loads import wave_forces
from hakobune.pipelines.cli import main
from hakobune.pipelines.moor.study import read_study

BOX = "box --length 100 --beam 50 --draft 10 --depth 20 --omega 0.15:2:50 --heading 0:90:4 --gyration 15.55,29.44,32.28"
SPRING = np.diag([5e6, 8e6, 0.0, 0.0, 0.0, 2e10])


@pytest.fixture(scope="session")
def database(tmp_path_factory):
    path = tmp_path_factory.mktemp("motion") / "box.h5"
    assert main([*BOX.split(), "--output", str(path)]) == 0
    return open_database(path)


@pytest.fixture(scope="session")
def on_springs(database):
    """The box on linear springs, without hull: everything but the memory of the water is linear and known"""
    return moored(database, spring=SPRING)


@pytest.fixture(scope="session")
def study():
    return read_study(Path(pipelines.__file__).parent / "scenes" / "moor_chain_12.toml")[0]


@pytest.fixture(scope="session")
def on_chains(database, study, on_springs):
    hull = study.hull_of(database.dimensions)
    system = study.system(hull, database.rotation_center, database.density, database.gravity)
    return moored(database, system, hull, memory=on_springs.memory)


@pytest.fixture(scope="session")
def without_hull(on_chains):
    return replace(on_chains, hull=None)


@pytest.fixture(scope="session")
def on_lines(database, on_springs):
    """The box on four chains of a catalogue"""
    line = UniformLine("chain", line_type("R3 studless 111 mm"), 260.0, "", "")
    legs = corner_legs(line, 100.0, 50.0, np.radians([45]), database.water_depth, 4e5)
    system = moored_body(legs, database.water_depth, database.rotation_center, database.density, database.gravity)
    return moored(database, system, memory=on_springs.memory)


@pytest.fixture(scope="session")
def coupled():
    """`Reader` of two bodies coupled by the water, 24 headings around, and its wave forces"""
    body = coupled_bodies(np.arange(24) * (np.pi / 12))
    return body, wave_forces(body)
