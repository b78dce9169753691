"""What functions give back, and units of motions beside shapes."""

from types import SimpleNamespace

import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.design.kinds import earthquake
from hakobune.pipelines.keys import schema
from hakobune.pipelines.response import findings
from hakobune.pipelines.simulate import work
from hakobune.pipelines.single_point import study


def test_schemas_are_given_back_by_their_paths(monkeypatch, tmp_path):
    monkeypatch.setattr(schema, "KINDS", {"a": 1, "b": 2})
    monkeypatch.setattr(schema, "schema", lambda kind: {"of": kind})
    made = schema.write_schemas(tmp_path / "new")
    assert made == [tmp_path / "new" / f"{kind}.schema.json" for kind in "ab"]
    assert [path.read_text() for path in made] == [f'{{\n "of": "{kind}"\n}}\n' for kind in "ab"]


def test_columns_of_runs_have_the_units_of_motions_and_of_shapes():
    words = ("surge", "sway", "heave", "roll", "pitch", "yaw", "bow", "twist")
    names, units = work.quantities_of(["l"], ["f"], words, shapes=("m", "rad"), loads=(("sag", "m"), ("moment", "N m")))
    assert dict(zip(names, units, strict=True)) == {
        "surge": "m",
        "sway": "m",
        "heave": "m",
        "roll": "rad",
        "pitch": "rad",
        "yaw": "rad",
        "bow": "m",
        "twist": "rad",
        "wave": "m",
        "wind speed": "m/s",
        "tension l": "N",
        "deflection f": "m",
        "reaction f": "N",
        "sag": "m",
        "moment": "N m",
    }


@pytest.mark.parametrize(
    ("record", "body", "database"),
    [("r.csv", None, "b.h5"), (None, None, "b.h5"), (None, "own", "b.h5"), (None, None, None)],
)
def test_an_earthquake_is_kept_by_its_study_database_and_record(monkeypatch, tmp_path, record, body, database):
    asked = []
    study = SimpleNamespace(record=record and SimpleNamespace(file=record), body=body)
    monkeypatch.setattr(earthquake, "read_study", lambda path: (study, "text"))
    monkeypatch.setattr(earthquake, "key_of", lambda *given: given)
    monkeypatch.setattr(earthquake, "kept", lambda place, key, made: asked.append((place, key())) or made())
    monkeypatch.setattr(earthquake, "_found", lambda *given: given)
    monkeypatch.setattr(earthquake, "plain", lambda found: found)
    monkeypatch.setattr(earthquake, "read_numbers", lambda found: found)
    place, base = tmp_path / "k.json", database and tmp_path / database
    found = earthquake.run(tmp_path / "e.toml", base, place)
    assert found == (study, tmp_path, None if body else base)
    assert asked == [(place, ("text", base, record and tmp_path / record))]


def test_the_keel_that_comes_nearest_to_the_bed_in_years_is_told(monkeypatch):
    """Of 2 m one leaves 0.5, of 3 m the other 0.75 m"""

    class Keel:
        def __init__(self, name, gap):
            self.name, self.gap = name, gap

    levels = {"bow": 1.5, "stern": 2.25}
    monkeypatch.setattr(findings, "KeelPoint", Keel)
    monkeypatch.setattr(findings, "keel_name", lambda point: point.name)
    monkeypatch.setattr(findings, "YEAR", 10.0)
    monkeypatch.setattr(findings, "_often", lambda term, gap: f"often {gap:g}")
    asked = []
    result = SimpleNamespace(
        points=[Keel("stern", 3.0), Keel("bow", 2.0), "deck"],
        long_term=lambda name: SimpleNamespace(level=lambda time: asked.append(time) or levels[name]),
    )
    assert list(findings._keel_in_years(result, 50.0)) == [
        "under keel: the drop reached once in 50 years leaves 0.5 of 2 m at bow, the least of all points; the hull "
        "touches the bed often 2; this includes waves only, not squat"
    ]
    assert set(asked) == {500.0}
    assert list(findings._keel_in_years(SimpleNamespace(points=["deck"]), 50.0)) == []


@pytest.mark.parametrize(
    ("table", "db", "says"),
    [
        (None, None, "mass is missing; give [mass] with added_surge, added_sway and added_yaw, or --database"),
        (None, True, None),
        ((0.1, 0.8, 0.7, None), None, None),
        ((0.1, 0.8, 0.7, 25.0), True, None),
        ((0.0, 0.0, 0.0, None), None, None),
        ((0.1, -0.8, 0.7, None), None, "mass: the added mass is -0.8 times the mass of the body; allowed: at least 0"),
        ((0.1, 0.8, 0.7, -25.0), None, "mass.gyration is -25"),
    ],
)
def test_the_mass_of_a_body_on_a_buoy_is_that_of_its_table_or_of_its_database(monkeypatch, table, db, says):
    """Box of 100 × 20 × 8 m; about the centre of mass, 3 m ahead of midship, or that of the database"""
    asked = []
    monkeypatch.setattr(study, "planar_mass", lambda *given: asked.append(given) or "planar")
    monkeypatch.setattr(study, "planar_mass_stored", lambda reader: f"stored {reader}")
    hull = SimpleNamespace(length=100.0, beam=20.0, draft=8.0, displacement=None, center=3.0)
    names = ("added_surge", "added_sway", "added_yaw", "gyration")
    given = SimpleNamespace(hull=hull, mass=table and SimpleNamespace(**dict(zip(names, table, strict=True))))
    known = db and SimpleNamespace(reader="reader", rotation_center=(7.0, 8.0, 9.0))
    if says:
        with pytest.raises(StudyError) as error:
            study._mass(given, known, 1000.0, False)
        assert str(error.value).startswith(says)
        return
    mass, center = study._mass(given, known, 1000.0, False)
    if table is None:
        assert (mass, center.tolist()) == ("stored reader", [7, 8])
    else:
        ((own, length, beam, shares, gyration),) = asked
        assert (mass, center.tolist()) == ("planar", [3, 0]) and (own, length, beam, gyration) == (
            1.6e7,
            100.0,
            20.0,
            table[3],
        )
        assert shares.tolist() == list(table[:3])
