"""Ships: volume, form, counts, what cannot be one; a ship through the panel method."""

import tomllib
from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.meshing.files import write_mesh
from hakobune.meshing.hydrostatics import hydrostatics
from hakobune.meshing.panels import structured
from hakobune.meshing.ship import CORNER, counts_of_ship, ship
from hakobune.pipelines import cli
from hakobune.pipelines.keys.kinds import SCENES
from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.solve.run import solve

TANKER, CONTAINER, FERRY = (300.0, 50.0, 18.0, 0.83), (280.0, 40.0, 14.0, 0.62), (120.0, 20.0, 5.34, 0.55)


@pytest.mark.parametrize("sizes", [TANKER, CONTAINER, FERRY])
def test_volume_is_that_of_the_block_coefficient_and_the_hull_closes(sizes):
    length, beam, draft, block = sizes
    for panels in (200, 500, 2000):
        made = ship(*sizes, panels=panels)
        assert made.volume == pytest.approx(block * length * beam * draft, rel=1e-12)
        assert 0.8 * panels < made.total <= panels and made.draft == draft
        whole = made.whole()
        assert np.abs(whole.area_vectors[:, :2].sum(axis=0)).max() < 1e-9 * length * beam
        assert made.normals[:, 2].max() <= 1e-9 and np.ptp(whole.points[:, 0]) == length


def test_beam_of_the_panels_comes_to_the_ships_at_second_order():
    off = [np.ptp(ship(*CONTAINER, counts=(n, n // 4, n // 4)).whole().points[:, 1]) / 40.0 - 1 for n in (24, 48, 96)]
    assert np.all(np.array(off) > 0) and np.all(np.log2(np.divide(off[:-1], off[1:])) > 1.7), off


def test_waterplane_is_what_the_middle_section_leaves():
    """C_W = C_B/C_M of a hull whose sections are alike"""
    length, beam, draft, block = TANKER
    middle = 1 - CORNER * 2 * (0.25 * draft) ** 2 / (beam * draft)
    made = hydrostatics(ship(*TANKER, panels=4000))
    assert made.waterplane_area == pytest.approx(block / middle * length * beam, rel=2e-3)
    assert abs(made.center_of_buoyancy[0]) < 1e-5 * length


def test_a_waterplane_fuller_than_the_hull_below_keeps_the_volume():
    """A car carrier of C_B 0.62 and C_WP 0.83, which a hull of sections alike cannot have"""
    length, beam, draft, block = CONTAINER
    made = hydrostatics(ship(*CONTAINER, waterplane=0.83, panels=6000))
    assert made.volume == pytest.approx(block * length * beam * draft, rel=1e-9)
    assert made.waterplane_area == pytest.approx(0.83 * length * beam, rel=3e-3)
    with pytest.raises(ValueError, match=r"waterplane coefficient is 0.95; allowed with block coefficient 0.62: 0\.3"):
        ship(*CONTAINER, waterplane=0.95)


@pytest.mark.parametrize("panels", [150, 500])
@pytest.mark.parametrize("waterplane", [0.75, 0.83, 0.9])
def test_the_panels_have_the_waterplane_and_the_beam_that_are_asked_for(waterplane, panels):
    """Flat panels cut the rounds; 0.90 gave 0.911 on 500 panels, and 1.4 % more beam"""
    length, beam, draft, block = CONTAINER
    mesh = ship(*CONTAINER, waterplane=waterplane, panels=panels)
    made = hydrostatics(mesh)
    assert made.waterplane_area == pytest.approx(waterplane * length * beam, rel=1e-5)
    assert made.volume == pytest.approx(block * length * beam * draft, rel=1e-9)
    assert 2 * mesh.points[:, 1].max() == pytest.approx(beam, rel=1e-5)


def test_a_waterplane_that_few_panels_cannot_draw_is_told():
    """Near the largest of the message the ends of eight panels along the hull would have to be fuller than is drawn"""
    length, beam, *_ = CONTAINER
    with pytest.raises(ValueError, match="allowed with block coefficient") as refused:
        ship(*CONTAINER, waterplane=0.999)
    high = float(str(refused.value).rsplit(" to ", 1)[1])
    with pytest.warns(
        UserWarning,
        match=r"waterplane coefficient of 0\.\d+, but .* is asked for; allowed: a difference of up to 0\.5 %",
    ):
        made = hydrostatics(ship(*CONTAINER, waterplane=high, counts=(8, 2, 3)))
    assert abs(made.waterplane_area / (high * length * beam) - 1) > 5e-3


def test_a_fuller_bow_moves_the_buoyancy_ahead():
    made = hydrostatics(ship(*TANKER, bow=0.85, stern=0.65, panels=500))
    assert made.center_of_buoyancy[0] > 0.005 * TANKER[0]


@pytest.mark.parametrize("counts", [(8, 2, 3), (31, 4, 5), (64, 7, 11)])
def test_counts_are_found_again_in_the_mesh(counts):
    assert counts_of_ship(ship(*FERRY, counts=counts)) == counts


@pytest.mark.parametrize(
    "change, says",
    [
        ({"block": 0.99}, "block coefficient is 0.99; allowed: 0.4 to 0.95"),
        ({"bow": 0.8}, "fullness is given for only one of bow and stern; give both or neither"),
        ({"block": 0.5, "bow": 0.9, "stern": 0.9}, "of the length; allowed: up to 50 %"),
        ({"block": None}, "block is missing; the keys of a ship are length, beam, draft, block"),
        ({"shape": "box", "block": None, "bow": 0.8}, "a box has only length, beam, draft"),
    ],
)
def test_what_cannot_be_a_ship_is_one_line(change, says):
    body = dict(zip(("length", "beam", "draft", "block"), CONTAINER, strict=True)) | {"shape": "ship"} | change
    raw = {
        "water": {"depth": 30.0},
        "bodies": [{k: v for k, v in body.items() if v is not None}],
        "waves": {"omegas": [0.5]},
    }
    with pytest.raises(SceneError) as caught:
        make_scene(raw)
    assert says in str(caught.value) and "\n" not in str(caught.value)


def test_a_ship_is_solved_from_its_dimensions(tmp_path):
    from hakobune.bem.database import open_database

    path = tmp_path / "ship.h5"
    words = "ship --length 120 --beam 20 --draft 5.34 --block 0.55 --depth inf --omega 0.1 --panels 160"
    assert cli.main([*words.split(), "--only", "radiation", "--output", str(path)]) == 0
    db = open_database(path)
    A, mass = np.asarray(db["added_mass"])[0], 1025 * 0.55 * 120 * 20 * 5.34
    assert float(db["displaced_volume"]) == pytest.approx(0.55 * 120 * 20 * 5.34, rel=1e-9)
    assert 0.01 < A[0, 0] / mass < 0.1 and 0.6 < A[1, 1] / mass < 1.1 and A[2, 2] > A[1, 1]
    assert db.dimensions == {"length": 120.0, "beam": 20.0, "draft": 5.34}


@pytest.mark.parametrize("name", ["tanker", "container", "ferry", "n_port"])
def test_ships_that_are_shipped_are_solved_with_the_laws_of_their_waves_kept(name, tmp_path):
    """At one frequency of their band"""
    raw = tomllib.loads((SCENES / f"ship_{name}.toml").read_text(encoding="utf-8"))
    raw |= {"waves": {"omegas": [0.5], "headings_deg": [0, 90]}, "tolerance": 0.2}
    solve(make_scene(raw), tmp_path / "ship.h5")
    db, body = open_database(tmp_path / "ship.h5"), raw["bodies"][0]
    volume = body["block"] * body["length"] * body["beam"] * body["draft"]
    assert float(db["displaced_volume"]) == pytest.approx(volume, rel=1e-3)
    A, X = np.asarray(db["added_mass"])[0], np.asarray(db["excitation_force"])[0]
    assert np.abs(A - A.T).max() < 0.01 * np.abs(A).max() and A[1, 1] > 3 * A[0, 0] > 0
    assert np.abs(X[1, 1]) > np.abs(X[0, 1]) and np.abs(X[0, 0]) > np.abs(X[1, 0])


def test_heave_added_mass_of_a_wigley_hull_is_that_of_another_code(tmp_path):
    """Wigley III of Journée (1992), ω√(L/g) = 3.34: 0.4410 ρ∇ by Capytaine 3.0.0 on 2048 panels, here on 512"""
    u, v = np.arange(33) / 32, np.arange(9) / 8
    xi, zeta = -np.cos(np.pi * u), np.sin(0.5 * np.pi * v)
    half = 0.15 * np.outer((1 - xi**2) * (1 + 0.2 * xi**2), 1 - zeta**2)
    half[[0, -1]] = half[:, -1] = 0.0
    points = np.stack(np.broadcast_arrays(1.5 * xi[:, None], half, -0.1875 * zeta), axis=-1)
    mesh = replace(structured(points), symmetry="y", name="Wigley hull")
    assert mesh.volume == pytest.approx(0.0780, rel=0.01)
    write_mesh(mesh, tmp_path / "wigley.msh")
    omega = 3.34 * np.sqrt(9.81 / 3)
    words = f"solve --mesh {tmp_path / 'wigley.msh'} --depth inf --omega {omega} --only added_mass --density 1000"
    assert cli.main([*words.split(), "--gravity", "9.81", "--output", str(tmp_path / "w.h5")]) == 0
    added_mass = np.asarray(open_database(tmp_path / "w.h5")["added_mass"])[0, 2, 2]
    assert added_mass == pytest.approx(0.4410 * 78.0, rel=0.02)


def breadths(made, at):
    """(p, 2) y, z of the points of a station, breadths as before they were scaled to the volume"""
    y, z = made.points[np.abs(made.points[:, 0] - at) < 1e-6 * np.ptp(made.points[:, 0]), 1:].T
    return np.stack([y, z], axis=1)


@pytest.mark.parametrize("sizes, radius", [((300.0, 50.0, 18.0, 0.83), 4.5), ((300.0, 28.0, 18.0, 0.83), 3.5)])
def test_the_middle_section_has_a_flat_bottom_a_round_bilge_and_a_straight_side(sizes, radius):
    """r₀ a quarter of the draft, or of half the beam where that is less"""
    _, beam, draft, _ = sizes
    made = ship(*sizes, counts=(20, 4, 9))
    y, z = breadths(made, 0.0).T
    y = y * 0.5 * beam / y.max()
    corner = 0.5 * beam - radius, radius - draft
    flat, side = z == -draft, (z > corner[1] + 1e-9) & (z <= 0)
    bilge = ~flat & ~side
    assert (flat.sum(), bilge.sum(), side.sum()) == (5, 5, 4)
    assert y[flat].max() == pytest.approx(corner[0]) and y[flat].min() == 0.0
    np.testing.assert_allclose(y[side], 0.5 * beam)
    np.testing.assert_allclose(np.hypot(y[bilge] - corner[0], z[bilge] - corner[1]), radius)
    # graded towards the bilge and towards the waterline: sin of even angles
    np.testing.assert_allclose(np.sort(y[flat]), corner[0] * np.sin(np.pi / 8 * np.arange(5)), atol=1e-9)
    np.testing.assert_allclose(np.sort(z[side]), corner[1] * np.cos(np.pi / 8 * np.arange(1, 5)), atol=1e-9)


def test_half_breadths_fall_as_a_power_along_entrance_and_run():
    """1 − tᵖ, p = φ/(1 − φ): l = 0.4 and φ from C_B = C_M {1 − 2 l (1 − φ)}; x points to the bow"""
    length, beam, draft, block = CONTAINER
    middle = 1 - (1 - np.pi / 4) * 2 * 3.5**2 / (beam * draft)
    phi = 1 - (1 - block / middle) / 0.8
    made = ship(*CONTAINER, counts=(24, 3, 4))
    stations = np.unique(made.points[:, 0].round(7))
    y = np.array([breadths(made, x)[:, 0].max() for x in stations])
    t = np.clip((np.abs(stations) / length - 0.1) / 0.4, 0, 1)
    np.testing.assert_allclose(y / y.max(), 1 - t ** (phi / (1 - phi)), atol=1e-6)

    bow, stern = 0.7, 0.55
    share = (1 - block / middle) / (2 - bow - stern)
    made = ship(*CONTAINER, bow=bow, stern=stern, counts=(24, 3, 4))
    y = np.array([breadths(made, x)[:, 0].max() for x in stations])
    t = np.clip((np.abs(stations) / length - (0.5 - share)) / share, 0, 1)
    fullness = np.where(stations > 0, bow, stern)
    np.testing.assert_allclose(y / y.max(), 1 - t ** (fullness / (1 - fullness)), atol=1e-6)


def test_panels_at_the_ends_are_half_as_long_as_evenly_spaced():
    """x/L = (u − ½)/2 − cos(πu)/4: slope ½ at the ends, curved by π²/4, and ½ + π/4 in the middle"""
    steps = np.diff(np.unique(ship(*TANKER, counts=(200, 2, 3)).points[:, 0].round(7))) * 200 / 300
    assert steps[[0, -1]] == pytest.approx(0.5 + np.pi**2 / 4 / 400, rel=1e-3)
    assert steps[[99, 100]] == pytest.approx(0.5 + np.pi / 4, rel=1e-3)


def test_panels_are_shared_out_by_the_roots_of_lengths():
    """√4L : √(B/2) : √8d, of half the ship's panels; no edge longer than asked for, though panels may be more"""
    length, beam, draft, _ = TANKER
    along, across, down = counts_of_ship(ship(*TANKER, panels=20000))
    assert along / across == pytest.approx(np.sqrt(4 * length / (beam / 2)), rel=0.04)
    assert down / across == pytest.approx(np.sqrt(8 * draft / (beam / 2)), rel=0.04)
    assert 0.97 * 20000 < 2 * along * (across + down) <= 20000
    assert ship(*TANKER, panels=200, longest=12.0).sizes.max() <= 12.0 * 1.05
    along, across, down = counts_of_ship(ship(*TANKER, panels=200, longest=12.0))
    assert (along, across, down) == (40, 4, 4)  # ⌈π/2 · 300/12⌉, ⌈π/2 · 25/12⌉, two on the bilge and two above it


def test_a_ship_is_named_by_its_numbers():
    assert ship(*FERRY, counts=(8, 2, 3)).name == "ship 120 x 20 x 5.34 m, block coefficient 0.55"


def test_limits_of_ships_from_both_sides():
    def says(words, *sizes, **more):
        with pytest.raises(ValueError, match=words):
            ship(*sizes, counts=(8, 2, 3), **more)

    length, beam, draft, block = CONTAINER
    says("length is 0.0 m; allowed: a positive length", 0.0, beam, draft, block)
    says("beam is -1", length, -1, draft, block)
    says("draft is inf m", length, beam, np.inf, block)
    ship(length, beam, draft, 0.95, counts=(8, 2, 3))
    says("block coefficient is 0.951; allowed: 0.4 to 0.95", length, beam, draft, 0.951)
    says("block coefficient is 0.399; allowed: 0.4 to 0.95", length, beam, draft, 0.399)
    says("block coefficient 0.4 with fullness 0.25", length, beam, draft, 0.4)  # φ < 0.3
    ship(length, beam, draft, 0.45, counts=(8, 2, 3))  # φ = 0.318
    for bow, stern in ((0.3, 0.97), (0.97, 0.5)):
        ship(length, beam, draft, 0.8, bow=bow, stern=stern, counts=(8, 2, 3))
    says("fullness of the bow is 0.29; allowed: 0.3 to 0.97", length, beam, draft, 0.8, bow=0.29, stern=0.9)
    says("fullness of the stern is 0.98; allowed: 0.3 to 0.97", length, beam, draft, 0.8, bow=0.5, stern=0.98)
    # an entrance of 49 and of 51 % of the length
    missing = 1 - block / (1 - (1 - np.pi / 4) * 2 * 3.5**2 / (beam * draft))
    ship(*CONTAINER, bow=1 - missing / 0.98, stern=1 - missing / 0.98, counts=(8, 2, 3))
    both = 1 - missing / 1.02
    says("needs an entrance of 51 % of the length; allowed: up to 50 %", *CONTAINER, bow=both, stern=both)


@pytest.mark.parametrize("block", [0.55, 0.62, 0.7, 0.83])
def test_a_waterplane_within_the_limits_of_the_message_is_taken_and_one_beyond_is_refused(block):
    """Allowed is what fullness of 0.3 to 0.97 at keel and waterline gives, entrances of 40 or 50 % of the length.

    ∫ Y dz over B/2 d is m₀, ∫ Y (1 + z/d) dz is m₁ of the middle section:
    C_B = m₀ (1 − 2a) + 2a {φ_k (m₀ − m₁) + φ_t m₁}, and C_WP = 1 − 2a (1 − φ_t)
    """
    length, beam, draft, _ = CONTAINER
    with pytest.raises(ValueError, match="allowed with block coefficient") as refused:
        ship(length, beam, draft, block, waterplane=0.999)
    low, high = (float(word) for word in str(refused.value).rsplit(": ", 1)[1].split(" to "))
    r = 0.25 * draft
    wide, high_up = 2 * r / beam, r / draft
    m0 = 1 - (1 - np.pi / 4) * wide * high_up
    m1 = 0.5 - (5 / 6 - np.pi / 4) * wide * high_up**2
    ends = []
    for a in (0.4, 0.5):
        top = [(block - m0 * (1 - 2 * a)) / (2 * a * m1) - keel * (m0 - m1) / m1 for keel in (0.3, 0.97)]
        ends += [1 - 2 * a * (1 - min(max(one, 0.3), 0.97)) for one in top]
    assert (low, high) == (pytest.approx(min(ends), abs=1e-3), pytest.approx(max(ends), abs=1e-3))
    assert min(ends) <= low < high <= max(ends)
    for waterplane in (low, high):
        made = hydrostatics(ship(length, beam, draft, block, waterplane=waterplane, counts=(100, 6, 9)))
        assert made.volume == pytest.approx(block * length * beam * draft, rel=1e-9)
        assert made.waterplane_area == pytest.approx(waterplane * length * beam, rel=5e-3)
    for waterplane in (low - 0.002, high + 0.002):
        with pytest.raises(ValueError, match="allowed with block coefficient"):
            ship(length, beam, draft, block, waterplane=waterplane)


@pytest.mark.parametrize("given", [{"bow": 0.7}, {"stern": 0.7}, {"bow": 0.7, "stern": 0.7}])
def test_a_waterplane_leaves_no_fullness_of_either_end_to_be_given(given):
    length, beam, draft, block = CONTAINER
    with pytest.raises(
        ValueError, match="waterplane is given together with fullness of bow or stern; give only one of the two"
    ):
        ship(length, beam, draft, block, waterplane=0.75, counts=(8, 2, 3), **given)
