"""The cases of the report's single-point series as studies, and the scenes of their floaters.

Tables 3.6.5.1 to 3.6.5.5 of the SR179 report (1982), digitised in single_point.csv.  Values that the report does not
state follow from its tables: six lines at ±30°, ±90° and ±150° of the wind, 12 and 18 lines are computed as six
lines of two and three times the weight; lines made fast at the buoy's draft; freeboards of 10 m; turning tests of
B/d = 10; a drift of c H² along the waves at any heading, c of the head-on rows of 14 m (A) and 40 m (B) in waves of
10 s, elsewhere in proportion to the drift that is computed; no wind moment, which would make the headings in an
oblique current 3 to 8° larger than printed.  Head-on forces that are printed for B at 40 m include a current force
12 % above that of the turning tests at H/d = 2 (76.8 t at 1.5 kn against 68.5 t), so that its tensions at 3 kn are
computed 4 to 8 % too low.
"""

from pathlib import Path
from typing import NamedTuple

from ..beside import number, read_rows

TABLE = Path(__file__).parent / "single_point.csv"
HEADINGS = [30, 90, 150, 210, 270, 330]
SCOPE = 40.0  # depths of line laid out; the anchor does not move
WAVES_AFTER, DURATION = 400.0, 1200.0  # s
ANGLES = [0, 15, 30, 45, 60, 75, 90]
WIND = {"x": [1, 0.98, 0.91, 0.75, 0.54, 0.28, 0], "y": [0, 0.17, 0.42, 0.64, 0.81, 0.93, 1]}
NUMBERS = ("height_m", "mean_period_s", "wind_m_s", "current_kn", "depth_m", "weight_t_m", "lines", "pretension_tonf")
PRINTED = ("heading_deg", "static_tonf", "significant_tonf", "scope", "hawser_tonf")


class Floater(NamedTuple):
    """Sizes, m; hawser : length, m; attached : depth of the lines' ends under water, m; breaking : breaking load, tonf

    drift, computed : drift over the square of the height, tonf/m², from the head-on rows, and by a database in these
        waves
    """

    length: float
    beam: float
    draft: float
    hawser: float
    attached: float
    breaking: float
    drift: float
    computed: float


FLOATERS = {
    "A": Floater(100.0, 50.0, 10.0, 25.0, 3.0, 785.0, 4.988, 4.846),
    "B": Floater(200.0, 100.0, 20.0, 50.0, 6.0, 1471.0, 8.314, 7.193),
}


class Case(NamedTuple):
    """A row of the table: name; {column: number}; system, "contact" or "buoy"; printed : {column: number, NaN where
    none is printed}
    flag : fault of the printed row
    """

    name: str
    floater: str
    values: dict
    current_deg: float
    system: str
    printed: dict
    flag: str = ""

    @property
    def together(self):
        """Number of lines that one of the six represents"""
        return max(1, round(self.values["lines"] / 6))

    @property
    def database(self):
        """Name of the database of its floater and depth"""
        return f"{self.floater}_{self.values['depth_m']:g}m"


def read_cases():
    """{name: Case} of the table, in its order"""
    return {row["case"]: Case(
        row["case"], row["floater"], {key: float(row[key]) for key in NUMBERS}, float(row["current_deg"] or 0.0),
        row["system"], {key: number(row[key]) for key in PRINTED}, row["flag"],
    ) for row in read_rows(TABLE)}  # fmt: skip


def study_of(case, seed=1, drift=None):
    """Nested dictionaries of the study of a case; drift : tonf over the square of the height, of the head-on rows"""
    f, v, n = FLOATERS[case.floater], case.values, case.together
    raw = {
        "water": {"depth": v["depth_m"]},
        "hull": {"length": f.length, "beam": f.beam, "draft": f.draft, "freeboard": 10.0},
        "attachment": {"x": 0.5 * f.length},
        "buoy": {"z": -f.attached},
        "types": {"chain": {"weight_kg_per_m": 1e3 * n * v["weight_t_m"], "breaking_load_tonf": n * f.breaking}},
        "mooring": {
            "type": "chain",
            "length": SCOPE * v["depth_m"],
            "headings_deg": HEADINGS,
            "top_tension_tonf": n * v["pretension_tonf"],
        },
        "wind": {"speed": v["wind_m_s"], "incidence_deg": 0.0, "coefficients": {"angles_deg": ANGLES, **WIND}},
        "current": {
            "speed_knots": v["current_kn"],
            "incidence_deg": case.current_deg,
            "waves": "still",
            "turning": {"beam_over_draft": 10.0},
        },
        "waves": {
            "height": v["height_m"],
            "period": 0.9 * v["mean_period_s"],  # T01 of T1/3 = T/0.9
            "incidence_deg": 0.0,
            "spectrum": "mitsuyasu_bretschneider",
            "drift_tonf_per_m2": f.drift if drift is None else drift,
        },
        "slewing": {"duration": DURATION, "waves_after": WAVES_AFTER, "seed": seed},
    }
    if case.system == "buoy":
        raw["hawser"] = {"length": f.hawser}
    return raw


def scene_of(case):
    """Raw tables of the scene of a case's floater, a uniform box, its centre of gravity in the waterplane"""
    f, depth = FLOATERS[case.floater], case.values["depth_m"]
    height = f.draft + 10.0
    squares = f.beam**2 + height**2, f.length**2 + height**2, f.length**2 + f.beam**2
    body = {"shape": "box", "length": f.length, "beam": f.beam, "draft": f.draft, "center_of_gravity": [0.0, 0.0, 0.0],
            "gyration": [(square / 12) ** 0.5 for square in squares]}  # fmt: skip
    return {
        "tolerance": 0.03,
        "want": ["radiation", "diffraction", "motions", "drift", "limits"],
        "water": {"depth": depth},
        "bodies": [body],
        "waves": {"periods": {"from": 4.5, "to": 40.0, "count": 20}, "headings_deg": [0, 22.5, 45, 67.5, 90]},
    }
