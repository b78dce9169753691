"""Which frequencies, nodes and columns represent a band, by hand, and how accurately each part is decomposed."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.panels.band import low_rank_waves
from hakobune.bem.panels.band.low_rank_waves import Snapshots
from hakobune.bem.waves import wavenumber

RNG = np.random.default_rng(11)
G, DEPTH, HULL, LID = 9.81, 15.0, 8, 3


def geometry(symmetry="", copies=4):
    """Two panels of four nodes on the hull, of 1 and 2 m, and three nodes of a lid"""
    heights = np.array([-0.2, -0.5, -1.0, -2.0, -3.0, -4.0, -0.1, -8.0, 0.0, 0.0, 0.0])
    elements = SimpleNamespace(nodes=np.stack([0 * heights, 0 * heights, heights], axis=1), inverse=np.zeros((2, 4, 4)),
                               sizes=np.array([1.0, 2.0]), weights=np.arange(1.0, 12.0))  # fmt: skip
    return SimpleNamespace(depth=DEPTH, radius=20.0, hull=HULL, elements=elements, copies=copies,
                           mesh=SimpleNamespace(symmetry=symmetry), classes=((1, 1), (-1, 1)))  # fmt: skip


class Recorded:
    def __init__(self):
        self.added = []

    def add(self, *parts, scale=1.0):
        self.added.append((np.concatenate(parts, axis=-2), np.array(scale)))


def test_wavenumbers_are_closer_in_long_waves_and_one_for_a_quarter_of_the_radius():
    """k₁ + (k₂ − k₁) (j/n)², of 3 + k₂R/4 rounded up; one of a band without width"""
    low, high = (float(wavenumber(w, DEPTH, G)) for w in (0.4, 1.9))
    found = Snapshots(geometry(), (0.4, 1.9), G).wavenumbers
    count = 3 + int(np.ceil(high * 20.0 / 4))
    assert found == pytest.approx([low + (high - low) * (j / (count - 1)) ** 2 for j in range(count)])
    assert Snapshots(geometry(), (0.7, 0.7), G).wavenumbers == pytest.approx([float(wavenumber(0.7, DEPTH, G))])


def test_columns_of_the_lid_count_a_tenth_of_those_of_the_hull():
    made = Snapshots(geometry(), (0.5, 0.9), G)
    assert made.root**2 == pytest.approx(np.arange(1.0, 12.0))
    assert made.column_scale[:HULL] == pytest.approx(made.root[:HULL])
    assert made.column_scale[HULL:] == pytest.approx(10 * made.root[HULL:])


@pytest.mark.parametrize("deep, most", [(0.4, np.inf), (2.0, 1.5), (0.8, 2.0)])
def test_nodes_within_a_panel_of_the_surface_are_samples_and_of_others_some(deep, most, monkeypatch):
    """(size/z)² up to 1, all together at most `most`, and `deep` of all n; of the lid at most `most`; test points"""
    made = Snapshots(geometry(), (0.5, 0.9), G)
    monkeypatch.setattr(made, "test_points", lambda: np.array([4, 6]))
    z, size = made.geometry.elements.nodes[:HULL, 2], np.repeat([1.0, 2.0], 4)
    strip = np.minimum(size**2 / z**2, 1.0)
    share = min(1.0, most / strip.sum())
    expected = np.minimum(strip * share + deep / HULL, 1.0)
    expected[[4, 6]] = 1.0
    found = made.probabilities(deep, most)
    assert found[:HULL] == pytest.approx(expected) and found[HULL:] == pytest.approx(min(1.0, most / LID))
    samples = made.samples(7, deep, most)
    assert samples.weights == pytest.approx(1 / found[samples.nodes])
    assert samples.hull == np.sum(samples.nodes < HULL) and {4, 6} <= set(samples.nodes.tolist())
    assert samples.on_lid.tolist() == samples.nodes[samples.nodes >= HULL].tolist()
    often = np.mean([np.isin(np.arange(HULL + LID), made.samples(n, deep, most).nodes) for n in range(400)], axis=0)
    assert often == pytest.approx(found, abs=0.1)


def test_the_highest_node_and_one_by_area_are_test_points():
    g = geometry()
    g.elements.weights = np.where(np.arange(11) == 3, 5.0, 1e-30)
    assert Snapshots(g, (0.5, 0.9), G).test_points().tolist() == [3, 6]


@pytest.mark.parametrize("block", [2_000_000, 25])
def test_columns_of_samples_are_weighted_by_their_probability_and_area(block, monkeypatch):
    """√(3w)/column scale of D and, over the length, of S; K times S of the lid; a sample at every third frequency"""
    monkeypatch.setattr(low_rank_waves, "LARGEST_BLOCK", block)
    made, asked = Snapshots(geometry(copies=2), (0.5, 0.9), G), []
    nodes, weights = np.array([0, 2, 3, 5, 7, 9, 10]), np.array([1.0, 2.0, 1.5, 3.0, 4.0, 1.0, 2.5])
    monkeypatch.setattr(made, "samples", lambda: (nodes, weights, 5))
    S, D = RNG.normal(size=(2, 2, 11, 11))

    def blocks(points, sources, start, step):
        asked.append((sources.tolist(), start, step))
        assert points.tolist() == list(range(11))
        yield 0.3, S[..., sources], D[..., sources]

    monkeypatch.setattr(made, "blocks", blocks)
    sketch = Recorded()
    made.add_sample_columns(sketch)
    assert sorted(n for sources, _, _ in asked for n in sources) == nodes.tolist()
    assert {start: step for _, start, step in asked} == {0: 3, 1: 3, 2: 3}
    assert [n for sources, start, _ in asked if start == 1 for n in sources] == [2, 7]
    assert max(len(sources) for sources, *_ in asked) == (3 if block > 25 else 2)
    length = np.sqrt(2 * np.sum(np.arange(1.0, 9.0)))
    wanted, scale = [], np.sqrt(3 * weights) / made.column_scale[nodes]
    for n, factor in zip(nodes, scale, strict=True):
        own = (S[..., n] * factor * 0.3,) if n >= HULL else (D[..., n] * factor, S[..., n] * factor / length)
        wanted += own
    found = [block[..., n] * scale[n] for block, scale in sketch.added for n in range(block.shape[-1])]
    size = lambda columns: sorted(np.round(np.ravel(columns).astype(float), 9))  # noqa: E731
    assert size(found) == pytest.approx(size(wanted))


def test_rows_of_points_are_those_of_the_hull_and_k_times_those_of_the_lid():
    """D of the hull and K S of the lid, weighted; S V beside S of the samples are kept for the monopoles"""
    made, S, D = Snapshots(geometry(), (0.5, 0.9), G), *RNG.normal(size=(2, 2, 2, 11))
    points, weights, samples = np.array([1, 4]), np.array([2.0, 3.0]), np.array([0, 6])
    velocities, kept = RNG.normal(size=(2, HULL, 3)), [["before"], ["before"]]
    made.blocks = lambda points, sources: iter([(0.3, S, D), (0.4, 2 * S, D)])
    sketch = Recorded()
    made.add_point_rows(sketch, points, weights, velocities, samples, kept)
    (block, scale), _ = sketch.added
    assert scale.tolist() == [2.0, 3.0] and block[:, :HULL] == pytest.approx(D[..., :HULL].swapaxes(1, 2))
    assert block[:, HULL:] == pytest.approx(0.3 * S[..., HULL:].swapaxes(1, 2))
    for c, layers in enumerate(kept):
        assert len(layers) == 2
        for layer, factor in zip(layers, (1, 2), strict=True):
            one = factor * np.hstack([S[c][:, :HULL] @ velocities[c], S[c][:, samples]]) * weights[:, None]
            assert layer == pytest.approx(one)


def test_monopoles_give_the_single_layers_of_all_frequencies():
    """S at the sources times M is S V at the points, real and imaginary parts alike"""
    made = Snapshots(geometry(), (0.5, 0.9), G)
    S = RNG.normal(size=(2, 2, 5, 3)) + 1j * RNG.normal(size=(2, 2, 5, 3))  # frequency, class, point, source
    M, weights = RNG.normal(size=(2, 3, 4)), RNG.uniform(1, 2, 5)
    made.blocks = lambda points, sources: ((0.1, part, None) for part in S)
    layers = [[(part[c] @ M[c]) * weights[:, None] for part in S] for c in range(2)]
    found = made.monopole_strengths(np.arange(5), weights, np.arange(3), layers, 1e-3)
    assert found == pytest.approx(M, rel=1e-8)


@pytest.mark.parametrize("symmetry, half", [("", np.pi), ("x", np.pi / 2)])
def test_the_flux_of_incident_waves_counts_alike_for_all_headings(symmetry, half, monkeypatch):
    """2π over its norm, or over a millionth of the largest class; three times as many wavenumbers, π/(8 + 4kR) apart"""
    made, asked = Snapshots(geometry(symmetry), (0.5, 0.9), G), []
    flux = lambda beta, k: np.array([np.cos(beta) * np.arange(1.0, 9.0) + k, 1e-9 * np.ones(8)])  # noqa: E731

    def waves(g, beta, omega, k):
        asked.append((beta, k))
        return None, flux(beta, k) + 0j

    monkeypatch.setattr(low_rank_waves, "class_waves", waves)
    sketch = Recorded()
    made.add_incident_flux(sketch)
    known = made.wavenumbers
    places = np.sort(np.concatenate([known, *((1 - s) * known[:-1] + s * known[1:] for s in (1 / 3, 2 / 3))]))
    assert len(sketch.added) == len(places)
    assert sorted({k for _, k in asked}) == pytest.approx(places)
    for (block, scale), k in zip(sketch.added, places, strict=True):
        own = [beta for beta, at in asked if at == pytest.approx(k)]
        assert own == pytest.approx(np.arange(0, half, np.pi / (8 + 4 * k * 20.0)))
        whole = np.concatenate([flux(beta, k) for beta in own])
        assert block == pytest.approx(whole.T)
        size = np.sqrt(whole**2 @ np.arange(1.0, 9.0))
        assert scale[::2] == pytest.approx(2 * np.pi / size[::2])
        assert scale[1::2] == pytest.approx(2 * np.pi / np.maximum(size[1::2], 1e-6 * size[::2]))


@pytest.mark.parametrize("few, share", [(1000, 1.0), (2, 0.5)])
def test_each_part_of_a_band_is_decomposed_to_its_accuracy(few, share, monkeypatch):
    """2π times the accuracy, of n nodes, more than a few, √(few/n) of it; the flux to a fifth; areas taken out"""
    assert low_rank_waves.FEW_NODES == 1000
    monkeypatch.setattr(low_rank_waves, "FEW_NODES", few)
    asked, given, hull = [], {}, 8
    root = np.sqrt(RNG.uniform(1, 2, hull + 2))
    scale = root * np.where(np.arange(hull + 2) < hull, 1.0, 10.0)

    class Known:
        def __init__(self, *arguments):
            self.root, self.column_scale = root, scale

        def add_incident_flux(self, sketch): ...
        def add_sample_columns(self, sketch): ...

        def samples(self, seed, deep, most):
            given["samples"] = seed, deep, most
            return SimpleNamespace(on_hull=np.array([0]))

        def test_points(self):
            return "points"

        def add_point_rows(self, *arguments):
            given["rows"] = arguments

        def monopole_strengths(self, *arguments):
            given["monopoles"] = arguments
            return np.arange(2.0 * 1 * (3 + 1)).reshape(2, 1, 4)

    parts = [RNG.normal(size=(hull, 1)), RNG.normal(size=(hull + 2, 2)), RNG.normal(size=(hull + 2, 2))]
    chosen = [np.array([2]), np.array([1, 4]), np.array([3, hull + 1])]

    def decomposed(fill, row_scale, tolerance):
        asked.append((np.array(row_scale), tolerance))
        fill("sketch")
        return chosen[len(asked) - 1], parts[len(asked) - 1].copy()

    monkeypatch.setattr(low_rank_waves, "Snapshots", Known)
    monkeypatch.setattr(low_rank_waves, "_decomposed", decomposed)
    monkeypatch.setattr(low_rank_waves, "ErrorTest", SimpleNamespace(of=lambda *them: them))
    modes = RNG.normal(size=(hull, 6))
    g = SimpleNamespace(hull=hull, classes=((1, 1), (-1, 1)), modes=modes,
                        members=lambda cls: [1, 2] if cls == (1, 1) else [0])  # fmt: skip
    found = low_rank_waves.low_rank_waves(g, (0.5, 0.9), G, 1e-3)
    tolerance = 2 * np.pi * 1e-3 * share
    assert [t for _, t in asked] == pytest.approx([0.2 * tolerance, tolerance, tolerance])
    for (rows, _), wanted in zip(asked, (root[:hull], root, 1 / scale), strict=True):
        assert rows == pytest.approx(wanted)
    assert [found.points.tolist(), found.sources.tolist(), found.flux_nodes.tolist()] == [[1, 4], [3, hull + 1], [2]]
    Z = parts[0] * root[2] / root[:hull, None]
    assert found.velocities[0] == pytest.approx(np.hstack([modes[:, [1, 2]], Z]))
    assert found.velocities[1] == pytest.approx(np.hstack([modes[:, [0]], 0 * Z, Z]))
    X, Y = found.X, found.Y
    assert np.allclose(X, parts[1] * root[[1, 4]] / root[:, None], rtol=1e-12)
    assert np.allclose(Y, (parts[2] * scale[:, None] / scale[[3, hull + 1]]).T, rtol=1e-12)
    weights = root[[1, 4]] * np.linalg.norm(parts[1], axis=0)
    _, points, own, velocities, samples, _ = given["rows"]
    assert points.tolist() == [1, 4] and own == pytest.approx(weights) and samples.tolist() == [0]
    assert velocities is found.velocities
    points, own, monopoles, _, accuracy = given["monopoles"]
    assert points.tolist() == [1, 4] and own == pytest.approx(weights)
    assert (monopoles.tolist(), accuracy, given["samples"][1:]) == ([3], 1e-3, (100, 100))
    assert found.M.tolist() == [[[0, 1, 2]], [[4, 5, 6]]]
    tested, _, of_X, of_Y, V, N, sizes = found.error_test
    assert (tested, N.tolist()) == ("points", [[[3]], [[7]]]) and of_X is X and of_Y is Y
    assert V is found.velocities and sizes == pytest.approx(root[:hull])


def test_blocks_are_of_every_second_frequency_and_tell_how_many_rows_they_stand_for(monkeypatch):
    """Waves of k (ω² = gk tanh kh) by a table as wide as the hull; 3 of 11 sources of two points are 6/11 of a row"""
    from hakobune.bem.kernels.progress import progress_callback

    made, asked, told = Snapshots(geometry(), (0.4, 1.9), G), [], []
    made.geometry.reach, made.geometry.draft = 44.0, 8.0
    monkeypatch.setattr(low_rank_waves, "wave_table", lambda *them: asked.append(them) or SimpleNamespace(K="K"))
    monkeypatch.setattr(low_rank_waves, "depth_values", lambda *them: them)
    monkeypatch.setattr(low_rank_waves, "wave_blocks", lambda g, points, sources, table, Z: ((points, sources), Z))
    with progress_callback(lambda *them: told.append(them)):
        found = list(made.blocks([1, 2], [3, 4, 5], 1, 2))
    k = made.wavenumbers[1::2]
    assert len(k) > 1 and told == [("waves", pytest.approx(6 / 11))] * len(k)
    assert [omega for omega, *_ in asked] == pytest.approx(np.sqrt(G * k * np.tanh(k * DEPTH)))
    assert {tuple(rest) for _, *rest in asked} == {(DEPTH, G, 44.0, 8.0)}
    assert found == [("K", ([1, 2], [3, 4, 5]), (one, DEPTH)) for one in k]


@pytest.mark.parametrize("rows", [2, 3, 256])
def test_rankine_equations_are_put_together_row_by_row_and_told(rows, monkeypatch):
    """2π − D on the hull, D on the lid, S V beside S of the lid, of each class; blocks end anywhere"""
    from hakobune.bem.kernels.progress import progress_callback
    from hakobune.bem.panels.band import equations

    monkeypatch.setattr(equations, "ROWS", rows)
    S, D = RNG.normal(size=(2, 2, HULL + LID, HULL + LID))
    g = geometry()
    g.elements.nodes[:, 0] = np.arange(HULL + LID)

    def rankine_rows(at):
        own = at[:, 0].astype(int)
        return S[:, own], D[:, own], None, None

    g.rankine_rows, told = rankine_rows, []
    V = RNG.normal(size=(2, HULL, 2))
    with progress_callback(lambda *them: told.append(them)):
        matrices, on_lid, sides = equations._rankine_equations(g, V)
    assert {stage for stage, _ in told} == {"matrices"}
    assert [count for _, count in told] == [min(rows, HULL + LID - start) for start in range(0, HULL + LID, rows)]
    for c in range(2):
        assert matrices[c] == pytest.approx(2 * np.pi * np.eye(HULL) - D[c, :HULL, :HULL])
        assert on_lid[c] == pytest.approx(D[c, HULL:, :HULL])
        assert sides[c] == pytest.approx(np.hstack([S[c, :, :HULL] @ V[c], S[c, :, HULL:]]))
    assert len(matrices) == len(on_lid) == len(sides) == 2


@pytest.mark.parametrize("lid", [LID, 0])
def test_unit_columns_of_a_class_are_solved_with_or_without_the_lid(lid):
    """(2π − D₀) φ = [X, S₀V, S₀ of the lid], φ at samples and sources, ∬ V φ over all images, D₀φ + … on the lid"""
    from scipy.linalg import lu_factor

    from hakobune.bem.panels.band.equations import BandEquations

    r, v, q, on_hull = 3, 2, 4, np.array([1, 5])
    X, Y, V = RNG.normal(size=(HULL + lid, r)), RNG.normal(size=(q, HULL + lid)), RNG.normal(size=(2, HULL, v))
    samples = SimpleNamespace(on_hull=on_hull, hull=len(on_hull))
    low_rank = SimpleNamespace(X=X, Y=Y, velocities=V, error_test=SimpleNamespace(samples=samples))
    u, g = r + v + lid, geometry(copies=2)
    empty = (np.full((2, rows, u), np.nan) for rows in (HULL, len(on_hull), v, q, lid))
    made = BandEquations(g, 1e-3, low_rank, *empty, None, None, None)
    A, on_lid = RNG.normal(size=(HULL, HULL)) + 6 * np.eye(HULL), RNG.normal(size=(LID, HULL))
    sides = RNG.normal(size=(HULL + LID, v + LID))
    made.solve_class(1, lu_factor(A.T), on_lid, sides)
    known = np.hstack([X, sides[: HULL + lid, : v + lid]])
    phi = np.linalg.solve(A, known[:HULL])
    assert made.unit_potentials[1] == pytest.approx(phi)
    assert made.potentials_at_samples[1] == pytest.approx(phi[on_hull])
    areas = 2 * g.elements.weights[:HULL]
    assert made.integrals[1] == pytest.approx(np.einsum("nv,n,nu->vu", V[1], areas, phi))
    assert made.at_sources[1] == pytest.approx(Y[:, :HULL] @ phi)
    assert made.on_lid[1] == pytest.approx(on_lid[:lid] @ phi + known[HULL:])
    assert np.isnan(made.unit_potentials[0]).all()
    with pytest.raises(FloatingPointError, match=r"hull \(symmetry class 0\) have no finite solution"):
        made.solve_class(0, lu_factor(A.T), on_lid, sides * np.nan)


def test_both_parts_of_a_band_are_solved_with_the_factors_of_each_class(monkeypatch):
    """Without and with the lid: S₀V of its own velocities, then S₀ of the lid"""
    from hakobune.bem.panels.band import equations

    solved, V = [], {"open": RNG.normal(size=(2, HULL, 2)), "lid": RNG.normal(size=(2, HULL, 3))}

    def empty(g, accuracy, low_rank):
        return SimpleNamespace(low_rank=low_rank, solve_class=lambda *them: solved.append((g, *them)))

    monkeypatch.setattr(equations, "split_by_lid", lambda *them: [("open", "low"), ("lid", "high")])
    monkeypatch.setattr(equations, "low_rank_waves", lambda g, *_: SimpleNamespace(velocities=V[g]))
    monkeypatch.setattr(equations.BandEquations, "empty", empty)
    sides = [np.arange(8) + 10.0 * c + np.zeros((2, 1)) for c in range(2)]  # 2 + 3 velocities and 3 nodes of the lid
    monkeypatch.setattr(equations, "_rankine_equations", lambda g, v: (["A", "B"], ["on lid A", "on lid B"], sides))
    monkeypatch.setattr(equations, "_factored", lambda matrix: f"factors of {matrix}")
    assert len(equations.band_equations("lid", (0.2, 1.1), G, 1e-3)) == 2
    wanted = [(name, c, f"factors of {A}", f"on lid {A}") for c, A in enumerate("AB") for name in ("open", "lid")]
    assert [one[:4] for one in solved] == wanted
    for (name, c, *_), side in zip(wanted, (one[4] for one in solved), strict=True):
        own = [0, 1, 5, 6, 7] if name == "open" else [2, 3, 4, 5, 6, 7]
        assert side[0].tolist() == [10.0 * c + n for n in own]
