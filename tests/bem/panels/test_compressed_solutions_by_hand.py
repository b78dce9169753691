"""Solutions of compressed equations without any: which columns go in, how they come out, and what is accepted."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.checks import sufficient_accuracy
from hakobune.bem.panels.compressed import equations, one_frequency, operator
from hakobune.bem.panels.compressed.one_frequency import CompressedRun
from hakobune.bem.panels.compressed.operator import CompressedEquations, Tree

RNG = np.random.default_rng(13)
ORDER = np.array([3, 0, 4, 1, 2])  # of five nodes in the tree, three of them on the hull


@pytest.fixture
def answers(monkeypatch):
    """What `solved` gets from the iteration and from the full equations, and what it asks"""
    made = SimpleNamespace(left=1e-7, compression=1e-5, asked={})

    def gmres(system, preconditioner, columns, residual, iterations):
        made.asked.update(columns=columns, residual=residual, iterations=iterations)
        made.x = RNG.normal(size=columns.values.shape) + 1j
        return made.x, made.left

    monkeypatch.setattr(equations, "tree_of", lambda geometry: SimpleNamespace(nodes=ORDER))
    monkeypatch.setattr(equations, "CompressedEquations", lambda *them: made.asked.update(system=them) or "system")
    monkeypatch.setattr(equations, "Preconditioner", lambda system: ("about", system))
    monkeypatch.setattr(equations, "gmres", gmres)
    monkeypatch.setattr(equations, "_left_of_full", lambda *them: made.asked.update(full=them) or made.compression)
    return made


G = SimpleNamespace(hull=3, signs=lambda cls: np.array([1.0, 1.0 if cls == "even" else -1.0]))
VELOCITIES = {"even": RNG.normal(size=(2, 3)), "none": np.zeros((0, 3)), "odd": RNG.normal(size=(1, 3))}


def test_columns_of_all_classes_are_solved_together_and_come_back_in_the_order_of_the_mesh(answers):
    found = equations.solved(G, VELOCITIES, 1.0, "table", "depths", 1e-4)
    columns = answers.asked["columns"]
    on_all = np.zeros((5, 3))
    on_all[:3] = np.concatenate([VELOCITIES["even"], VELOCITIES["odd"]]).T
    assert columns.values == pytest.approx(on_all[ORDER])
    assert columns.signs.tolist() == [[1, 1, 1], [1, 1, -1]]
    assert answers.asked["system"][1:4] == ("table", 1.0, "depths") and answers.asked["system"][5] == 1e-4
    assert (answers.asked["residual"], answers.asked["iterations"]) == (3e-7, 400)
    in_mesh = np.empty_like(answers.x)
    in_mesh[ORDER] = answers.x
    assert found.potentials["even"] == pytest.approx(in_mesh[:, :2].T)
    assert found.potentials["odd"] == pytest.approx(in_mesh[:, 2:].T) and found.potentials["none"].shape == (0, 5)
    assert (found.residual, found.compression) == (1e-7, 1e-4)  # at least the tolerance of the blocks
    answers.compression = 1.9e-3
    assert equations.solved(G, VELOCITIES, 1.0, "table", "depths", 1e-4).compression == 1.9e-3
    assert set(answers.asked["full"][1]) == set(answers.asked["full"][2]) == {"even", "odd"}


@pytest.mark.parametrize("left, compression, refused", [
    (2.9e-6, 1e-5, None), (3.1e-6, 1e-5, "a residual of 3.1e-06 is left after 400 iterations; allowed: 3e-06"),
    (np.nan, 1e-5, "a residual of nan is left"), (1e-7, 2.1e-3, "have an error of 2.1e-03; allowed: 0.002"),
    (1e-7, np.nan, "have an error of nan"), (1e-7, 1.99e-3, None),
])  # fmt: skip
def test_what_is_left_and_what_compression_does_are_within_their_limits(answers, left, compression, refused):
    answers.left, answers.compression = left, compression
    if refused is None:
        equations.solved(G, VELOCITIES, 1.0, "table", "depths", 1e-4)
        return
    with pytest.raises(FloatingPointError) as told:
        equations.solved(G, VELOCITIES, 1.0, "table", "depths", 1e-4)
    assert refused in str(told.value) and "5 compressed equations" in str(told.value)


@pytest.mark.parametrize("at_once", [8, 2])
def test_what_full_equations_leave_is_the_root_mean_square_of_their_rows(at_once, monkeypatch):
    """hull 2πφ − Dφ − K S φ' + S V, lid 4πφ' + K S φ' + Dφ − S V; over the sides; the worst column of all classes"""
    monkeypatch.setattr(equations, "SAMPLES_AT_ONCE", at_once)
    n, hull, K = 5, 3, 0.4
    S, D = RNG.normal(size=(2, 2, n, n)) + 1j
    asked = []

    def layers(g, rows, classes, mirror, table, depth_values):
        asked.append(len(rows))
        assert (classes, mirror, depth_values) == (["even", "odd"], -1.0, "depths")
        return S[:, rows], D[:, rows]

    monkeypatch.setattr(equations, "layers", layers)
    g = SimpleNamespace(hull=hull, elements=SimpleNamespace(nodes=range(n)))
    phi = {cls: RNG.normal(size=(2, n)) + 1j for cls in ("even", "odd")}
    V = {cls: RNG.normal(size=(2, hull)) for cls in phi}
    found = equations._left_of_full(g, phi, V, -1.0, SimpleNamespace(K=K), "depths")
    ratios = []
    for i, cls in enumerate(phi):
        for column in range(2):
            x, v = phi[cls][column], V[cls][column]
            D_phi, S_phi, SV = D[i][:, :hull] @ x[:hull], S[i][:, hull:] @ x[hull:], S[i][:, :hull] @ v
            left = np.where(np.arange(n) < hull, 2 * np.pi * x - D_phi - K * S_phi + SV,
                            4 * np.pi * x + D_phi + K * S_phi - SV)  # fmt: skip
            ratios.append(np.linalg.norm(left) / np.linalg.norm(SV))
    assert found == pytest.approx(max(ratios)) and asked == ([5] if at_once == 8 else [2, 2, 1])
    phi["odd"] = phi["odd"][:1]  # as many columns as a class has
    V["odd"] = V["odd"][:1]
    assert equations._left_of_full(g, phi, V, -1.0, SimpleNamespace(K=K), "depths") == pytest.approx(max(ratios[:3]))
    phi["odd"] = phi["odd"] * np.nan
    assert np.isnan(equations._left_of_full(g, phi, V, -1.0, SimpleNamespace(K=K), "depths"))


def test_blocks_are_as_accurate_as_a_tenth_of_what_so_many_panels_need(monkeypatch):
    asked = []

    def solved(g, velocities, mirror, table, depths, tolerance):
        asked.append((velocities, mirror, table, tolerance))
        return SimpleNamespace(residual=1e-8, compression=2e-5,
                               potentials={"even": np.arange(10.0).reshape(2, 5)})  # fmt: skip

    monkeypatch.setattr(one_frequency, "solved", solved)
    monkeypatch.setattr(one_frequency, "wave_table", lambda *them: them)
    run = object.__new__(type("Run", (CompressedRun,), {"columns": {"even": 1}, "depth_values": "depths"}))
    run.omega, run.problem = 0.8, SimpleNamespace(depth=9.0, gravity=9.81, mesh=SimpleNamespace(total=5000))
    run.geometry, run._timed = SimpleNamespace(reach=40.0, draft=5.0, hull=3), lambda *them: None
    run.velocities = lambda cls: f"V {cls}"
    found = run._solved()
    assert asked == [({"even": "V even"}, 1.0, (0.8, 9.0, 9.81, 40.0, 5.0), 0.1 * sufficient_accuracy(5000))]
    assert found["even"].tolist() == [[0, 1, 2], [5, 6, 7]] and (run._residual, run._compression) == (1e-8, 2e-5)


def test_limits_of_the_frequency_are_compressed_to_what_so_many_panels_need(monkeypatch):
    members = {"even": [2], "odd": [0, 4]}
    g = SimpleNamespace(classes=("even", "odd"), mesh=SimpleNamespace(total=7000))
    velocities = [RNG.normal(size=(3, 1)), RNG.normal(size=(3, 2))]
    asked = []
    monkeypatch.setattr(one_frequency, "given_at_limit", lambda prepared, which: (g, velocities, "table", -1.0))
    potentials = {cls: RNG.normal(size=(len(own), 5)) + 1j for cls, own in members.items()}
    found = SimpleNamespace(potentials=potentials)
    monkeypatch.setattr(one_frequency, "solved", lambda *them: asked.append(them) or found)
    monkeypatch.setattr(one_frequency, "added_mass_of", lambda prepared, found, which: (prepared, found, which))
    prepared, found, which = one_frequency.added_mass_limit("prepared", "infinity")
    assert (prepared, which) == ("prepared", "infinity")
    for own, cls in zip(found, members, strict=True):
        assert np.array_equal(own, potentials[cls].real)
    same, given, mirror, table, _, tolerance = asked[0]
    assert same is g and (mirror, table, tolerance) == (-1.0, "table", sufficient_accuracy(7000))
    assert [np.array_equal(given[cls], v.T) for cls, v in zip(members, velocities, strict=True)] == [True, True]


@pytest.mark.parametrize("kept", [True, False])
def test_rankine_parts_of_near_blocks_are_kept_where_they_are_few(kept):
    made, asked = object.__new__(Tree), []
    made.kept = [None, None] if kept else None
    made.elements, made.span = SimpleNamespace(nodes=np.arange(12.0)), lambda leaf: slice(4 * leaf, 4 * leaf + 4)
    vars(made)["neighbours"] = [(0, [(0, np.array([1])), (3, np.array([0, 1]))]), (2, [(1, np.array([2]))])]

    def rankine(at, m, panels):
        asked.append((at.tolist(), m, panels.tolist()))
        return np.full((2, 2), m + 0.1), np.full((2, 2), -m - 0.1), "unused"

    made.rankine = rankine
    for _ in range(2):
        found = made.near_rankine(0)
        assert [(S[0, 0], D[0, 0]) for S, D in found] == [(np.float32(0.1), np.float32(-0.1)),
                                                          (np.float32(3.1), np.float32(-3.1))]  # fmt: skip
        assert found[0][0].dtype == np.float32
    assert asked == [([0, 1, 2, 3], 0, [1]), ([0, 1, 2, 3], 3, [0, 1])] * (1 if kept else 2)
    made.near_rankine(1)
    assert asked[-1] == ([8, 9, 10, 11], 1, [2])


def test_far_blocks_are_allowed_their_share_of_the_tolerance(monkeypatch):
    """ε over images and nodes, times the size of S or 2π; what they add to the sides is theirs on the images"""
    made, rng = object.__new__(CompressedEquations), np.random.default_rng(3)
    far = np.array([[0, 1, 0], [1, 0, 1], [0, 1, 1]])
    spans = {0: slice(0, 2), 1: slice(2, 5)}
    made.tree = SimpleNamespace(far=far, nodes=np.arange(5), span=spans.get,
                                geometry=SimpleNamespace(images=[(1, 1), (-1, 1)]))  # fmt: skip
    asked, blocks = [], {}

    def compressed(own, single, double):
        asked.append((single, double))
        for t, s, m in own:
            rows, columns = (spans[k].stop - spans[k].start for k in (t, s))
            blocks[t, s, m] = rng.normal(size=(rows, 1)), *rng.normal(size=(2, 1, columns))
            yield blocks[t, s, m]

    monkeypatch.setattr(operator, "parallel_rows", lambda work, parts, pairs: work(0, parts))
    made._compressed = compressed
    images, sides = rng.normal(size=(2, 5, 2)), rng.normal(size=(5, 2)) + 0j
    before = sides.copy()
    found = made._far_blocks(images, sides, 1e-3)
    size, each = np.abs(before).max() / np.abs(images).max(), 1e-3 / (2 * 5)
    assert asked and all(pair == pytest.approx((size * each, 2 * np.pi * each)) for pair in asked)
    wanted = before.copy()
    for (t, s, m), (U, _, V_S) in blocks.items():
        wanted[spans[t]] += U @ (V_S @ images[m][spans[s]])
    assert sides == pytest.approx(wanted)
    assert sorted((t, s, m) for t, s, m, _, _ in found) == sorted(map(tuple, far.tolist()))
    for t, s, m, U, V in found:
        assert U.dtype == V.dtype == np.float32 and blocks[t, s, m][0] == pytest.approx(U, rel=1e-6)
        assert blocks[t, s, m][1] == pytest.approx(V, rel=1e-6)
