"""Selection of solver and body: the list of measurements of a bench."""

from dataclasses import dataclass, field

TOLERANCES, PANELS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6), (60, 120, 250, 500, 1000)
SHARED = (250, 1000, 4000)  # panels of frequencies that share their work
ALL = ("cylinder-15", "cylinder-30", "cylinder-100", "box-12", "box-20", "box-100")
CHOSEN = ("cylinder-30", "box-20")  # cases run with two threads too, and with less favourable settings
PROGRAMS = ("hakobune", "capytaine", "pyhams")
GAUSS = "Gauss-Legendre 2"


@dataclass(frozen=True)
class Job:
    """One process: a program with its settings on a body

    fineness : tolerance, or panels on the whole hull; options : options of the program's script
    empty_cache : with nothing compiled or tabulated on disk
    """

    case: str
    program: str
    settings: str
    fineness: float
    threads: int
    options: dict = field(default_factory=dict)
    empty_cache: bool = False

    @property
    def title(self):
        many = f"{self.fineness:g}" if self.fineness < 1 else f"{self.fineness:g} panels"
        threads = f"{self.threads} thread{'s' * (self.threads > 1)}"
        return f"{self.case} {self.program} {self.settings} {many}, {threads}{', empty cache' * self.empty_cache}"


def plan(programs, threads, quick=False):
    """The jobs of a bench, in the order in which they run

    programs : one of PROGRAMS; threads : numbers of threads, the first with every case; quick : a few of them
    """
    jobs = [] if quick else [job for program in programs for job in COLD[program](threads[0])]
    for number in threads:
        cases = ALL if number == threads[0] and not quick else CHOSEN
        jobs += [job for program in programs for case in cases for job in WARM[program](case, number, quick)]
    return jobs


def _ours(case, threads, quick):
    for tolerance in TOLERANCES[1:4:2] if quick else TOLERANCES:
        yield Job(case, "hakobune", "contour", tolerance, threads, {"method": "contour"})
    round_too = (4000,) if case == "cylinder-30" else ()  # each frequency alone, by its rotation
    for panels in PANELS[1:3] if quick else (*PANELS, *round_too):
        yield Job(case, "hakobune", "panel", panels, threads, {"method": "panel"})
    for panels in (500,) if quick else SHARED if case in CHOSEN else SHARED[:2]:
        yield Job(case, "hakobune", "panel, band", panels, threads, {"method": "panel", "band": True})


def _capytaine(case, threads, quick):
    """The direct method on a graded mesh is the best of its settings throughout; a cylinder has rotation, too"""
    every = not quick and threads == 1
    large = () if quick or case not in CHOSEN else (2000,) if threads == 1 else (4000,)  # 7 GB
    for panels in (240,) if quick else (240, 960, *large):
        yield _of_capytaine(case, threads, panels)
    if case.startswith("cylinder"):
        for panels in (960,) if quick else (240, 960, 2500, 4000):
            yield _of_capytaine(case, threads, panels, symmetry="rotation")
    for panels in (240, 960) if every else ():
        yield _of_capytaine(case, threads, panels, graded=False)
        yield _of_capytaine(case, threads, panels, quadrature=GAUSS)
        if case in CHOSEN:
            yield _of_capytaine(case, threads, panels, method="indirect")


def _of_capytaine(case, threads, panels, graded=True, symmetry="xy", method="direct", quadrature=None, cold=False):
    mirror = {"xy": "2 planes", "rotation": "rotation"}[symmetry]
    settings = ", ".join((method, "graded" if graded else "uniform", mirror) + (("Gauss 2",) if quadrature else ()))
    options = {"graded": graded, "symmetry": symmetry, "method": method, "quadrature": quadrature}
    return Job(case, "capytaine", settings, panels, threads, options, cold)


def _hams(case, threads, quick):
    if case in CHOSEN:
        for panels in (240,) if quick else (240, 480, 960)[: 3 if threads == 1 else 2]:
            for graded in (True, False)[: 1 if quick or threads > 1 or panels > 500 else 2]:
                settings = f"{'graded' if graded else 'uniform'}, 1 plane"
                yield Job(case, "pyhams", settings, panels, threads, {"graded": graded, "symmetry": "y"})


def _cold_ours(threads):
    for method, fineness in (("contour", 1e-3), ("panel", 250)):
        yield Job("box-20", "hakobune", method, fineness, threads, {"method": method}, True)


def _cold_capytaine(threads):
    yield _of_capytaine("box-20", threads, 240, cold=True)


COLD = {"hakobune": _cold_ours, "capytaine": _cold_capytaine, "pyhams": lambda threads: ()}
WARM = {"hakobune": _ours, "capytaine": _capytaine, "pyhams": _hams}
