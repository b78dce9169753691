"""The report of a project: one page without external files, and its tables as CSV.

The content of the page is independent of time and place: the same inputs give the same report.
"""

import os
from importlib.resources import files

import numpy as np

from hakobune.meshing.whole_files import write_whole
from hakobune.mooring.criteria.strength import equipment_of_box

from ..printing.number import fixed
from . import report_words as words
from .checklist import checklist
from .kinds.versions import versions
from .report_pictures import body_pictures, plans, records, use_picture
from .report_tables import WORDS, origin, write_tables
from .tables import MEAN
from .verdict import FAILS, OPEN, PASSES

CSS = {PASSES: "passes", FAILS: "fails", OPEN: "open"}


def write_report(read, verdict, advice, paths, folder):
    """Write report.html, cases.csv, criteria.csv and parts.csv into a folder; returns the names of the written files.

    verdict : from `judged_project`; advice : from `advise`, or None; paths : {level: database}
    """
    from jinja2 import Environment, StrictUndefined

    template = files(__package__).joinpath("page.html").read_text(encoding="utf-8")
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    environment.filters["css_text"] = _css_text
    page = environment.from_string(template).render(**_context(read, verdict, advice, paths, folder))
    write_whole(folder / "report.html", page)
    return "report.html", *write_tables(read.project.project.name, verdict, folder)


def _context(read, verdict, advice, paths, folder):
    own, links = read.project.project, {one.case.name: _relative(one.path, folder) for one in verdict.ran}
    door, sources, method = read.kind.words(read.project, read.study)
    (head, parts), warned = words.part_table(read, verdict), list(words.warnings(verdict))
    return {
        "name": own.name,
        "note": own.note,
        "issue": words.issue(own),
        "word": verdict.word,
        "word_class": CSS[verdict.word],
        "summary": words.summary(verdict),
        "advice": words.advice_words(advice, verdict),
        "levels": list(_levels(read, paths, folder)),
        "return_period": words.return_words(own, verdict),
        "in_time": words.time_words(read),
        "not_run": sum(one.numbers is None for one in verdict.ran),
        "mooring": list(words.mooring_words(read)),
        "states": [words.state_row(state) for state in read.project.states],
        **_of_body(read, paths, folder),
        "lines": list(words.line_rows(read, verdict)),
        "criteria": [words.criterion(one, _found_in(read, verdict, folder)) for one in verdict.judged],
        "cases": [words.case(one, links) for one in verdict.ran],
        "rule_sets": [words.rule_set(one) for one in verdict.rule_sets if own.other_rules],
        "checklist": [
            (one.text, WORDS[one.met] if one.met is not None else "does not apply", words.MARK[one.met], one.how)
            for one in checklist(read, verdict.ran)
        ],
        "part_head": head,
        "parts": parts,
        "plans": list(plans(read, verdict, paths, folder)),
        "records": list(records(verdict, folder)),
        "motions": list(words.motion_rows(verdict)),
        "use_picture": use_picture(verdict, folder),
        "warnings": [one for one in warned if not one["aside"]],
        "aside": [one for one in warned if one["aside"]],
        "band": words.band(verdict),
        "door": door,
        "sources": sources,
        "method": method,
        "inputs": {"project": read.text, "study": read.study_text, "scene": _scene_text(read)},
        "versions": ", ".join(f"{name} {version}" for name, version in versions().items()),
    }


def _levels(read, paths, folder):
    """Each level with its depth, m, and the address of its database"""
    for name, path in paths.items():
        depth = read.study["water"]["depth"] + read.project.level(name)
        yield {"name": name, "depth": f"{depth:g}", "link": "" if path is None else _relative(path, folder)}


def _found_in(read, verdict, folder):
    """For each (name of a load case, criterion), the address of the file with the number, "" for the project's, and its
    key"""
    ran = {one.case.name: one for one in verdict.ran}

    def found(name, criterion):
        one = ran.get(words.with_factor(name, criterion.motion_factor), ran[name])
        path, key = origin(read, one, criterion)
        return "" if path is None else _relative(path, folder), key

    return found


def _of_body(read, paths, folder):
    """Text of the page on the body and its waves; without a database, on the study alone"""
    from hakobune.bem.database import open_database

    if paths[MEAN] is None:
        return {"body": read.kind.body(read.study), "checks": [], "equipment": [], "body_pictures": []}
    db = open_database(paths[MEAN])
    return {
        "body": _body_words(db),
        "checks": list(_checks(paths)),
        "equipment": [(society, f"{number:.0f}") for society, number in _equipment(read, db)],
        "body_pictures": body_pictures(paths[MEAN], folder),
    }


def _css_text(text):
    """A text inside quotes of a style sheet, escaped so that it ends neither quotes, rule nor element"""
    return "".join(letter if letter.isalnum() or letter in " .,-" else f"\\{ord(letter):x} " for letter in text)


def _relative(path, folder):
    return os.path.relpath(path, folder).replace(os.sep, "/")


def _body_words(db):
    from hakobune.bem.bodies.one_of_several import each_body

    from ..moor.study import box_of

    if db.bodies:
        pairs = zip(db.bodies, each_body(db), strict=True)
        hulls = ". ".join(f"{body.name}: {_hull_words(db, box_of(db, body), one)}" for body, one in pairs)
    else:
        hulls = _hull_words(db, db.dimensions, db)
    shortest, longest = 2 * np.pi / db.omega[[-1, 0]]
    return (
        f"{hulls}. {db.mesh.total} panels; {len(db.omega)} periods from {shortest:.3g} to {longest:.3g} s, "
        f"{len(db.wave_direction)} headings."
    )


def _hull_words(db, sizes, one):
    """Sizes, displacement and centre of gravity of one body of a database, of several in coordinates of the scene"""
    words = ", ".join(f"{name} {value:g} m" for name, value in sizes.items()) or "A body from a mesh file"
    x, y, z = one.center_of_mass
    return (
        f"{words}; displacement {_whole(1e-3 * db.density * one.displaced_volume)} t, centre of gravity {x:.4g}, "
        f"{y:.4g}, {z:.4g} m (z up from the water)"
    )


def _whole(value):
    """Four digits, of a number below 100 three, thousands apart"""
    return f"{float(fixed(float(f'{value:.4g}'), 0)):,.15g}".replace(",", " ")


def _checks(paths):
    """Results of the checks of the databases, one line each"""
    from hakobune.bem.database import open_database

    from ..solve.report import ESTIMATED, checked, given_panels

    failed = False
    for level, path in paths.items():
        db = open_database(path)
        for one in checked(db):
            if not one.passed:
                failed, text = True, f"{level}: {one.name} is {one.largest:.2g} at ω {one.omega:.3g} rad/s"
                if one.name in ESTIMATED and given_panels(db):
                    text = f"{level}: the estimated error of {one.name.removeprefix('estimated_')} is at most "
                    text += f"{100 * one.largest:.2g} %, at ω {one.omega:.3g} rad/s; "
                    yield {"css": "source", "text": f"{text}the scene gives panels, so that no tolerance was asked for"}
                    continue
                yield {"css": "fails", "text": f"{text}; limit {one.limit:g}"}
    text = "reciprocity, Haskind relation, energy, residual, estimated errors, each against its stored limit."
    yield {"css": "source", "text": f"Checked{' besides' if failed else ', and passed'}: {text}"}


def _equipment(read, db):
    if db.bodies:  # the numbers are those of one hull
        return ()
    freeboard = read.study.get("hull", {}).get("freeboard")
    return equipment_of_box(db.dimensions, freeboard, db.density * db.mesh.whole().volume)


def _scene_text(read):
    scene = read.project.project.scene
    return "" if scene is None else (read.folder / scene).read_text(encoding="utf-8")
