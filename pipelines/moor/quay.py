"""The body of a study at its quay: by the far field of open water, or from a database solved with the wall."""

from ..common.quantities import StudyError

METHODS = ("far-field", "panels")
# remaining part of local waves over the way to the quay and back: reported above the first, refused above the second
SAID, REFUSED = 0.05, 0.3
GIVEN_BACK = 0.01  # negative damping over the largest damping, above which it is reported
SAME = 1e-6  # m, of the wall of a database and the quay of a study
NO_DRIFT = "wave drift in front of the quay is unknown and not included"
_made = {}


def body_of(study, db):
    """`Reader` of a database's body at the quay of a `Study`, unchanged without a quay; and messages

    raises : StudyError where quay and database do not fit
    """
    quay, wall = study.quay, db.wall
    if quay is None:
        return db.bodies_reader, () if wall is None else (f"{db.path} includes a wall at y = {wall:g} m: {NO_DRIFT}",)
    if method_of(quay, wall, db.path) == "panels":
        return db.reader, (f"the quay at y = {quay.y:g} m is computed by panels with the wall; {NO_DRIFT}",)
    return by_far_field(db, quay.y)


def method_of(quay, wall, name):
    """far-field or panels, for a QuayTable.  Raises StudyError if quay and body do not match.

    wall : y of the wall in the body's solution, m, None for open water; name : name of its database or scene
    """
    method = quay.method or ("far-field" if wall is None else "panels")
    if method not in METHODS:
        raise StudyError(f"quay.method is {method!r}; allowed: {', '.join(METHODS)}")
    if method == "panels" and (wall is None or abs(wall - quay.y) > SAME):
        has = "of open water" if wall is None else f"for a wall at y = {wall:g} m"
        raise StudyError(
            f'quay.method is "panels" with a quay at y = {quay.y:g} m, and {name} is {has}; solve it again with '
            f"--wall {quay.y:g}"
        )
    if method == "far-field" and wall is not None:
        raise StudyError(
            f'quay.method is "far-field", but {name} is for a wall at y = {wall:g} m; allowed: a database of open water'
        )
    return method


def by_far_field(db, y):
    """`Reader` of a body of an open-water database at a quay at y, m, and remarks. Raises StudyError."""
    from hakobune.bem.wave_field.before_wall import WallError, before_wall, given_back, neglected

    try:
        key = db.path, db.header, y
        if key not in _made:
            made = before_wall(db.reader, y)
            made = made, neglected(db.reader, y), given_back(made)
            _made.clear()
            _made[key] = made
    except WallError as error:
        raise StudyError(f"quay: {error}") from None
    made, left_out, energy = _made[key]
    share = 100 * left_out
    told = (
        f"the quay at y = {y:g} m is computed by the far field; local waves near the hull are not included, although "
        f"{share:.3g} % of their height is left after the way to the quay and back"
    )
    if left_out > REFUSED:
        raise StudyError(f"{told}; allowed: up to {100 * REFUSED:g} %; solve the body with hakobune solve --wall {y:g}")
    if left_out > SAID:
        told += (
            f"; more than {100 * SAID:g} %: forces and added mass have errors of about this size; hakobune "
            f"simulate models the quay by panels, from a database by hakobune solve --wall {y:g}"
        )
    if energy > GIVEN_BACK:
        told += (
            f"; damping in front of it falls to {-energy:.2g} of its largest value, and must not be negative: "
            "solve with headings every 15° or less, and to a smaller tolerance"
        )
    return made, (told,)
