"""Runs of a frequency on panels without solving: which follows which, what is taken from which mesh, and bounds."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.checks import enlarged, share_left
from hakobune.bem.kernels.progress import FINER, progress_callback
from hakobune.bem.panels import extrapolated, frequency_limits
from hakobune.bem.panels import one_frequency as alone
from hakobune.bem.panels.band import one_frequency as band
from hakobune.bem.panels.compressed.one_frequency import CompressedRun
from hakobune.bem.panels.extrapolated import ExtrapolatedRun

RNG = np.random.default_rng(4)


def a_run(kind=alone.PanelRun, **held):
    """A run of a kind that holds these values, in place of its own properties too"""
    own = {name: value for name, value in held.items() if isinstance(getattr(kind, name, None), property)}
    made = object.__new__(type(kind.__name__, (kind,), own))
    vars(made).update({name: value for name, value in held.items() if name not in own})
    return made


def test_a_finer_mesh_is_told_and_asked_the_same_question():
    asked, told = [], []
    finer = SimpleNamespace(run=lambda *question, refined: asked.append((question, refined)) or "finer run")
    one = a_run(prepared=SimpleNamespace(finer=finer), omega=0.7, question=(0.7, [0.0], {"rao"}, None, ("Surge",)))
    with progress_callback(lambda *them: told.append(them)):
        made = one.on_finer_mesh
        assert asked == told == []
        assert made() == "finer run"
    assert told == [(FINER, (finer, 0.7))] and asked == [(one.question, one)]
    one.prepared.finer = None
    assert one.on_finer_mesh is None


@pytest.mark.parametrize("coarse, finer, told, wanted", [
    (None, "finer", 0.5, None), ("coarse", None, 0.5, None), ("coarse", "finer", 0.99, "extrapolated"),
    ("coarse", "finer", 1.01, "on the next mesh"),
])  # fmt: skip
def test_what_is_sharper_is_extrapolated_where_that_is_trusted_and_else_on_the_next_mesh(coarse, finer, told, wanted):
    class Run(alone.PanelRun):
        on_finer_mesh = property(lambda self: lambda: "on the next mesh")

    one = a_run(Run, coarse=coarse, problem=SimpleNamespace(finer=finer))
    better = SimpleNamespace(tolerances=told)
    vars(one)["extrapolated"] = better
    found = one.sharper
    assert (None if found is None else found()) == (better if wanted == "extrapolated" else wanted)


def test_a_coarser_run_is_the_one_that_is_refined_or_that_of_the_coarser_mesh():
    prepared = SimpleNamespace(coarse=SimpleNamespace(run=lambda *question: question))
    assert a_run(refined="known", prepared=prepared).coarse == "known"
    assert a_run(refined=None, prepared=prepared, question=(1, 2)).coarse == (1, 2)
    assert a_run(refined=None, prepared=SimpleNamespace(coarse=None)).coarse is None
    assert a_run(coarse=None).differences is None


def meshes(refinement=2.0):
    """A run, the coarser one beside it, and the share of their difference that the finer one still has"""
    names = ("radiation", "froude_krylov", "diffraction", "haskind")
    rough = SimpleNamespace(residual=3e-9, **{name: RNG.normal(size=(2, 6)) for name in names})
    fine = SimpleNamespace(
        **{name: RNG.normal(size=(2, 6)) for name in names}, coarse=rough, residual=2e-9, k=0.4,
        kochin=[RNG.normal(size=4), RNG.normal(size=4)], kochin_errors=[RNG.normal(size=4), RNG.normal(size=4)],
        differences=(RNG.normal(size=(6, 6)), RNG.normal(size=(2, 6))), refined="refined", on_finer_mesh="finer",
        problem=SimpleNamespace(mesh=SimpleNamespace(sizes=np.array([1.0, 3.0, 2.0]))),
        enlarged=lambda *them: ("enlarged", *them), drift_of_each=lambda moving: ("drift", moving),
        pressure=lambda: "pressure",
    )  # fmt: skip
    share = share_left(refinement)
    return a_run(ExtrapolatedRun, run=fine, share=share, k=0.4), fine, rough, share


def test_what_is_linear_is_carried_on_by_the_difference_of_two_meshes():
    """f − s (f' − f), s of the order of panels; Kochin functions less their errors; the rest as on the mesh"""
    one, fine, rough, share = meshes()
    assert 0 < share < 1
    for name in ("radiation", "froude_krylov", "diffraction", "haskind"):
        wanted = getattr(fine, name) + share * (getattr(fine, name) - getattr(rough, name))
        assert getattr(one, name) == pytest.approx(wanted)
    for found, H, error in zip(one.kochin, fine.kochin, fine.kochin_errors, strict=True):
        assert found == pytest.approx(H - error)
    assert one.residual == 3e-9 and one.refined == "refined" and one.sharper == "finer" and one.solves
    assert one.enlarged(1, 2) == ("enlarged", 1, 2) and one.drift_of_each(True) == ("drift", True)
    assert one.pressure() == "pressure"
    fine.haskind = None
    assert meshes()[0].run is not fine and a_run(ExtrapolatedRun, run=fine, share=share).haskind is None
    fine.residual = 4e-9
    assert one.residual == 4e-9


def test_what_is_left_over_rises_with_the_square_of_panels_over_the_wave():
    """0.12 + 4 (s/λ)², one at most; of errors of coefficients and of Kochin functions alike"""
    one, fine, *_ = meshes()
    left = 0.12 + 4 * (3.0 * 0.4 / (2 * np.pi)) ** 2
    assert one.left_over == pytest.approx(left)
    for found, error in zip(one.differences, fine.differences, strict=True):
        assert found == pytest.approx(left * error)
    for found, error in zip(one.kochin_errors, fine.kochin_errors, strict=True):
        assert found == pytest.approx(left * error)
    assert extrapolated.left_over(0.0) == 0.12 and extrapolated.left_over(0.5) == 1.0


def test_errors_of_kochin_functions_are_the_share_of_the_difference():
    one = a_run(prepared=SimpleNamespace(refinement=2.0), kochin=[np.array([1.0, 2.0])],
                coarse=SimpleNamespace(kochin=[np.array([1.5, 1.0])]))  # fmt: skip
    assert one.kochin_errors[0] == pytest.approx(share_left(2.0) * np.array([0.5, -1.0]))


def test_compression_moves_forces_by_no_more_than_its_share_of_potential_times_normal():
    """ρ ε ‖φ‖ ‖nⱼ‖ over the whole hull, and ω times it of waves; the larger of both orders"""
    areas, modes = np.array([1.0, 2.0, 3.0]), RNG.normal(size=(3, 6))
    potentials = {cls: RNG.normal(size=(3, 3)) + 1j for cls in ("even", "odd")}
    members = {"even": [0, 2, 4], "odd": [1, 3, 5]}
    one = a_run(
        CompressedRun, omega=0.8, headings=[0.1, 0.2], problem=SimpleNamespace(density=1025.0), _compression=1e-4,
        geometry=SimpleNamespace(copies=4, members=members.get), prepared=SimpleNamespace(modes=modes),
        hull=(None, areas, None), potentials=potentials, columns={"even": ([0, 2], [1]), "odd": ([1], [0, 1])},
    )  # fmt: skip
    radiation, excitation = one.compression_errors
    size = np.sqrt(4 * np.sum(areas[:, None] * modes**2, axis=0))
    own = {cls: np.sqrt(4 * np.sum(areas * np.abs(phi) ** 2, axis=1)) for cls, phi in potentials.items()}
    wanted, forces = np.zeros((6, 6)), np.zeros((2, 6))
    for cls, moving, waves in (("even", [0, 2], [1]), ("odd", [1], [0, 1])):
        for column, dof in enumerate(moving):
            wanted[dof, members[cls]] = 1025.0 * 1e-4 * own[cls][column] * size[members[cls]]
        for column, wave in enumerate(waves, len(moving)):
            forces[wave, members[cls]] = 0.8 * 1025.0 * 1e-4 * own[cls][column] * size[members[cls]]
    assert radiation == pytest.approx(np.maximum(wanted, wanted.T)) and excitation == pytest.approx(forces)
    given = RNG.normal(size=(6, 6)) + 1j, np.where(forces > 0, 1j, 0.0)
    found = one.enlarged(*given)
    assert found[0] == pytest.approx(enlarged(given[0], radiation))
    assert found[1] == pytest.approx(enlarged(given[1], excitation))
    rejected = a_run(band.BandRun, solution=None, geometry=SimpleNamespace(hull=band.LARGEST_FULL_SYSTEM + 1))
    vars(rejected)["compression_errors"] = one.compression_errors
    assert [part.shape for part in rejected.enlarged(*given)] == [(6, 6), (2, 6)]
    assert rejected.enlarged(*given)[1] == pytest.approx(found[1])


@pytest.mark.parametrize("net, infinite", [(1.05, True), (0.95, False)])
def test_motions_whose_flux_is_rounding_of_the_area_have_finite_added_mass(net, infinite):
    """The product of two fluxes above 1e-9 of the squared area of the whole hull, at zero frequency in finite depth"""
    weights = np.array([2.0, 3.0])
    area = 4 * 5.0
    flux = net * np.sqrt(1e-9) * area / 20.0
    modes = np.zeros((2, 6))
    modes[:, 2], modes[:, 0] = flux, [0.3, -0.2]
    members = {(1, 1): [2], (-1, 1): [0, 4], (1, -1): [1, 3], (-1, -1): [5]}
    g = SimpleNamespace(modes=modes, elements=SimpleNamespace(weights=np.append(weights, 9.0)), hull=2, copies=4,
                        classes=tuple(members), members=members.get)  # fmt: skip
    problem = SimpleNamespace(transform=np.eye(6), density=1000.0, depth=9.0, moving=[0, 2, 4])
    prepared = SimpleNamespace(geometry=g, problem=problem)
    potentials = [np.full((len(own), 2), -0.5) for own in members.values()]
    found = frequency_limits.added_mass_of(prepared, potentials, "zero")
    assert found.shape == (6, 3) and np.isinf(found[2, 1]) == infinite
    # ∬ φ n dS of what is odd in x: no flux leaves it, whatever its normals add up to
    assert found[0, 0] == pytest.approx(1000.0 * 0.5 * 4 * (2 * 0.3 - 3 * 0.2)) and np.isfinite(found[0]).all()
    assert np.isfinite(frequency_limits.added_mass_of(prepared, potentials, "infinity")).all()
    problem.depth = np.inf
    assert np.isfinite(frequency_limits.added_mass_of(prepared, potentials, "zero")).all()


def test_a_limit_of_which_one_potential_is_not_finite_is_refused(monkeypatch):
    """One number of one class among finite ones"""
    v = [np.ones((3, 1)), np.ones((3, 2))]
    g = SimpleNamespace(sectors=0, classes=((1, 1), (-1, 1)))
    found = SimpleNamespace(matrices=[None, None], sides=v)
    potentials = [np.ones((1, 3)), np.ones((2, 3))]
    monkeypatch.setattr(frequency_limits, "given_at_limit", lambda prepared, which: (g, v, None, -1.0))
    monkeypatch.setattr(frequency_limits, "assembled", lambda *given: found)
    monkeypatch.setattr(frequency_limits, "solved_systems", lambda matrices, sides: [p.T for p in potentials])
    monkeypatch.setattr(frequency_limits, "added_mass_of", lambda prepared, potentials, which: which)
    assert frequency_limits.added_mass_limit(None, "infinity") == "infinity"
    potentials[1][1, 2] = np.nan
    with pytest.raises(FloatingPointError, match="added mass at infinity frequency: the solution is not finite"):
        frequency_limits.added_mass_limit(None, "infinity")


def test_a_frequency_that_its_band_does_not_suit_is_that_of_the_whole_equations(monkeypatch):
    """Potentials, residual and integrals over the hull; of one that it suits, those of the reduced equations"""
    for name in ("potentials", "residual", "pressure_integrals", "haskind_integrals"):
        monkeypatch.setattr(alone.PanelRun, name, property(lambda self, name=name: f"whole {name}"))
        one = a_run(band.BandRun, solution=None)
        assert getattr(one, name) == f"whole {name}"
    members = {"even": [0, 2, 4], "odd": [1, 3]}
    g = SimpleNamespace(members=members.get, classes=("even", "other", "odd"))
    low_rank = SimpleNamespace(flux_nodes=np.array([1, 3]), points=np.arange(2))
    # per class: 3 motions at most and 2 flux nodes; columns of two motions and one wave, and of two waves
    integrals = RNG.normal(size=(2, 5, 3)) + 1j
    coefficients = RNG.normal(size=(2, 7, 3)) + 1j
    unit = RNG.normal(size=(3, 6, 7))
    solution = SimpleNamespace(integrals=integrals, residual=3e-13, coefficients=coefficients)
    flux = {"even": (None, RNG.normal(size=(2, 6))), "odd": (None, RNG.normal(size=(2, 6)))}
    one = a_run(
        band.BandRun, solution=solution, geometry=g, columns={"even": ([0, 4], [1]), "odd": ([], [0, 1])},
        equations_of_band=SimpleNamespace(low_rank=low_rank, unit_potentials=unit), incident=[flux],
    )  # fmt: skip
    one.on_hull, one._timed = (lambda x, velocities: x.T), (lambda *them: None)
    assert one.residual == 3e-13
    whole = {"even": integrals[0], "odd": integrals[1][:, :2]}
    for cls, values in whole.items():
        count = len(members[cls])
        assert one.pressure_integrals[cls] == pytest.approx(values.T[:, :count])
        moving = len(one.columns[cls][0])
        haskind = flux[cls][1][:, [1, 3]] @ values[3:, :moving]
        assert one.haskind_integrals[cls] == pytest.approx(haskind)
    assert one.potentials["even"] == pytest.approx((unit[0] @ coefficients[0]).T)
    assert one.potentials["odd"] == pytest.approx((unit[2] @ coefficients[1][:, :2]).T)


@pytest.mark.parametrize("wanted, indices", [(("even", "odd"), [0, 2]), (("even", "other", "odd"), slice(None))])
def test_a_band_solves_the_classes_that_are_wanted(wanted, indices):
    g = SimpleNamespace(classes=("even", "other", "odd"))
    parts = [SimpleNamespace(geometry="another"), SimpleNamespace(geometry=g)]
    prepared = SimpleNamespace(band_equations=parts)
    one = a_run(band.BandRun, geometry=g, columns=dict.fromkeys(wanted), prepared=prepared)
    assert one.wanted == indices and one.equations_of_band is parts[1]
