"""Panel files of other programs that list numbered points, then panels by point numbers.

    Nemoh       `2 s`, s = 1 for the mirror plane y = 0; points; a line of zeros; panels; a line of zeros
    Salome      numbers of points and of elements; points; elements `number type corners`, 203 and 204 are panels
    Diodore     points; *RETURN; panels `number corners`
    AQWA        a deck COOR of points, a deck ELM1 of panels QPPL and TPPL; SYMX, SYMY (AQWA reference manual, 7.2)
    WAMIT       _pan.dat for Tecplot, with three decimals, the whole hull in the axes of the water: one FEPOINT zone of
                corners and then panels, or a zone of 2 × 2 corners for each panel, of any orientation
    HydroStar   COORDINATES; PANEL TYPE 0 (corners) or 1 (number, corners); SYMMETRY_BODY
    HAMS        numbers of panels, points, mirror planes; points; panels `number 3-or-4 corners`

Corners run counter-clockwise seen from the water in all formats except WAMIT's zones of one panel.  Readers change no
orientation.
"""

import re
from dataclasses import replace

import numpy as np

from .panels import PanelMesh
from .text_files import is_number, read_text
from .text_formats import _number, _numbers, _panel, _symmetry

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
PANEL_OF = {"203": 3, "204": 4}  # corners of Salome's types


def read_dat(path):
    """The panels of a `.dat` of Nemoh, WAMIT, Salome, Diodore or AQWA; its contents show the format.  Raises
    ValueError."""
    text = read_text(path, errors="replace")
    first = text.split("\n", 1)[0].split()
    if re.search(r"^\s*\d*\s*COOR\s*$", text, re.MULTILINE):
        return _aqwa(path, text)
    if "*RETURN" in text:
        return _diodore(path, text)
    if re.match(r"\s*zone\b", text, re.IGNORECASE):
        return _tecplot(path, text)
    if len(first) == 2 and all(word.isdecimal() for word in first) and int(first[1]) > 1:
        return _salome(path, text)
    return read_nemoh(path)


def read_nemoh(path):
    """Nemoh mesh: `2 s` with s = 1 for the mirror plane y = 0, points, a line of zeros, panels, zeros."""
    rows = [(k, line.split()) for k, line in enumerate(read_text(path, errors="replace").splitlines(), 1)]
    rows = [(k, [_number(path, k, word) for word in words]) for k, words in rows if words]
    if not rows or len(rows[0][1]) < 2 or rows[0][1][1] not in (0, 1):
        raise ValueError(
            f"{path}: line 1 is neither '2 0' nor '2 1'; give '2 1' for a mesh with the mirror plane y = 0, else '2 0'"
        )
    symmetry = "y" if rows[0][1][1] else ""
    points, panels, numbers = [], [], {}
    rest = iter(rows[1:])
    for k, row in rest:
        if row[0] == 0:
            break
        if len(row) < 4:
            raise ValueError(f"{path}, line {k} has {len(row)} values; a point needs four: its number and its x, y, z")
        numbers[row[0]] = len(points)
        points.append(row[1:4])
    else:
        raise ValueError(f"{path}: no line '0 0. 0. 0.' after the points")
    for k, row in rest:
        if row[0] == 0:
            break
        panels.append(_panel(path, k, row, numbers))
    return PanelMesh(np.array(points), np.array(panels), symmetry)


def read_pnl(path):
    """HAMS hull mesh: numbers of panels, points and mirror planes, then points, then panels with 3 or 4 corners."""
    rows = []
    for k, line in enumerate(read_text(path, errors="replace").splitlines(), 1):
        words = line.split("!")[0].split()
        if words and is_number(words[0]):
            rows.append((k, [_number(path, k, word) for word in words]))
    if not rows or len(rows[0][1]) < 4:
        raise ValueError(f"{path}: no line with numbers of panels, nodes, x symmetry, y symmetry")
    n_panels, n_points = (int(value) for value in rows[0][1][:2])
    symmetry = _symmetry(path, rows[0][0], rows[0][1][2:4])
    if len(rows) != 1 + n_points + n_panels:
        raise ValueError(
            f"{path} has {len(rows) - 1} lines of numbers, but {n_points} nodes and {n_panels} panels need "
            f"{n_points + n_panels}"
        )
    points, numbers = [], {}
    for k, row in rows[1 : 1 + n_points]:
        if len(row) < 4:
            raise ValueError(f"{path}, line {k} has {len(row)} numbers; a node needs four: its number and its x, y, z")
        numbers[row[0]] = len(points)
        points.append(row[1:4])
    panels = []
    for k, row in rows[1 + n_points :]:
        if len(row) < 2 or row[1] not in (3, 4) or len(row) < 2 + row[1]:
            raise ValueError(f"{path}, line {k}: a panel has a number, then 3 or 4, then as many nodes")
        panels.append(_panel(path, k, row[2 : 2 + int(row[1])], numbers))
    return PanelMesh(np.array(points), np.array(panels), symmetry)


def _tecplot(path, text):
    """Zones of one panel have mirror images with normals into the body: each quarter is turned so that its volume is
    positive; panels of the lid, which are among them, are left out"""
    points, panels = [], []
    for k, line in enumerate(text.splitlines(), 1):
        words = line.split()
        if not words or words[0].lower() == "zone":
            continue
        if len(words) == 4:
            panels.append((k, [int(_number(path, k, word)) for word in words]))
        else:
            points.append(_numbers(path, k, line, 3))
    numbers = {number: place for place, number in enumerate(range(1, len(points) + 1))}
    if not panels and len(points) % 4 == 0:
        each = np.reshape(points, (-1, 4, 3))[:, [0, 2, 3, 1]]
        each = each[np.any(each[..., 2] != 0, axis=1)].reshape(-1, 3)
        hull = PanelMesh(each, np.arange(len(each)).reshape(-1, 4))
        quarter = (hull.centroids[:, :2] > 0) @ [1, 2]
        inward = np.bincount(quarter, np.einsum("ni,ni->n", hull.centroids, hull.area_vectors), 4) < 0
        return replace(hull, corners=np.where(inward[quarter, None], hull.corners[:, ::-1], hull.corners))
    corners = [_panel(path, k, row, numbers) for k, row in panels]
    return PanelMesh(np.reshape(points, (-1, 3)), np.reshape(corners, (-1, 4)).astype(int))


def _salome(path, text):
    rows = [(k, line.split()) for k, line in enumerate(text.splitlines(), 1) if line.strip()]
    count = int(rows[0][1][0])
    panels = [
        (k, words[2 : 2 + PANEL_OF[words[1]]]) for k, words in rows[1 + count :] if words[1:] and words[1] in PANEL_OF
    ]
    return _mesh(path, rows[1 : 1 + count], panels, "")


def _diodore(path, text):
    rows = [(k, line.split()) for k, line in enumerate(text.splitlines(), 1) if line.strip()]
    end = next(i for i, (_, words) in enumerate(rows) if words[0] == "*RETURN")
    rest = [(k, words[1:]) for k, words in rows[end + 1 :] if not words[0].startswith("*")]
    return _mesh(path, rows[:end], rest, "")


def _aqwa(path, text):
    """Points of the deck COOR, panels of the only non-empty deck ELM; other elements are ignored"""
    points, decks, symmetry, within = [], [], set(), ""
    for k, line in enumerate(text.splitlines(), 1):
        words = line.split("*")[0].split()
        name = next((word for word in words[:2] if re.fullmatch(r"COOR|ELM\w*|FINI", word)), None)
        if " DECK " in line or name == "FINI":
            within = ""
        elif name:
            within = name
            decks += [[]] if name != "COOR" else []
        elif within == "COOR" and len(words) > 1 and words[0].isdecimal():
            points.append((k, [line[6:11], *NUMBER.findall(line[11:])]))  # fields of fixed width, often without blanks
        elif within.startswith("ELM"):
            symmetry |= {axis for card, axis in (("SYMX", "y"), ("SYMY", "x")) if card in line[:16]}
            if re.search(r"[QT]PPL", line[:16]):
                decks[-1].append((k, [word.strip() for word in re.findall(r"\(([^)]*)\)", line)[1:5]]))
    bodies = [panels for panels in decks if panels]
    if len(bodies) != 1:
        raise ValueError(
            f"{path} has {len(bodies)} structures of panels (QPPL, TPPL); allowed: one structure in a file"
        )
    return _mesh(path, points, bodies[0], "".join(sorted(symmetry)))


def read_hydrostar(path):
    """HydroStar's mesh of one body; raises ValueError for other files, such as a WAMIT matrix file, which has the
    same ending."""
    rows = [(k, line.split()) for k, line in enumerate(read_text(path, errors="replace").splitlines(), 1)]
    rows = [(k, words) for k, words in rows if words]
    points, panels, symmetry, within, kind = [], [], "", "", 0
    for k, words in rows:
        head = words[0].upper()
        if head in ("COORDINATES", "PANEL", "ENDCOORDINATES", "ENDPANEL"):
            within, kind = head, int(words[2] == "1") if head == "PANEL" and len(words) > 2 else kind
        elif head == "SYMMETRY_BODY" and len(words) > 2:
            symmetry = {"0": "", "1": "y", "2": "xy"}.get(words[2], "")
        elif head in ("NBODY", "NBBODY") and words[1:] != ["1"]:
            raise ValueError(f"{path}, line {k} announces {' '.join(words[1:])} bodies; allowed: one body in a file")
        elif within == "COORDINATES":
            points.append((k, words))
        elif within == "PANEL":
            panels.append((k, words[kind:]))
    if not points:
        raise ValueError(
            f"{path} has no COORDINATES, which a mesh of HydroStar has; if it is a matrix of WAMIT, it is not a mesh"
        )
    return _mesh(path, points, panels, symmetry)


def _mesh(path, points, panels, symmetry):
    """PanelMesh of rows (line, words): points `number x y z`, panels of corner numbers; triangles may repeat one"""
    numbers, places, corners = {}, [], []
    for k, words in points:
        if len(words) < 4:
            raise ValueError(
                f"{path}, line {k} has {len(words)} values; a point needs four: its number and its x, y, z"
            )
        row = [_number(path, k, word) for word in words[:4]]
        numbers[row[0]] = len(places)
        places.append(row[1:])
    for k, words in panels:
        row = [_number(path, k, word) for word in words]
        corners.append(_panel(path, k, row[:-1] if row[0] == row[-1] else row, numbers))
    return PanelMesh(np.reshape(places, (-1, 3)), np.reshape(corners, (-1, 4)).astype(int), symmetry)
