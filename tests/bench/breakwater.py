"""Floating breakwaters by potential theory beside the tests of Kihara, Kitatani & Todoroki (1975), and their times.

python tests/bench/breakwater.py [tables] [times] [snap] [loss] [moving] [length]
"""

import csv
import sys
import time
from collections import defaultdict
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from scipy.optimize import minimize_scalar

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.sections.any_section import any_section, shape
from hakobune.bem.sections.coefficients import section
from hakobune.bem.sections.keel_loss import keel_flow
from hakobune.bem.sections.outline import circle, closed, rectangle
from hakobune.mooring.breakwater.anchors import pretension_needed
from hakobune.mooring.breakwater.body import TautBody
from hakobune.mooring.breakwater.exact import taut_exact
from hakobune.mooring.breakwater.holdings import Response, exact_response, response_with_loss
from hakobune.mooring.breakwater.long_waves import equal_area, fixed_body, line_tensions
from hakobune.mooring.breakwater.loss import Keel, with_loss
from hakobune.mooring.breakwater.snap import frequencies, snap
from hakobune.mooring.breakwater.taut import TautRectangle

WATER = {"density": 1000.0, "gravity": 9.8}
BODY = {"half": 0.3, "draft": 0.3, "free_draft": 0.202, "depth": 0.6, "z0": -0.095, "inertia": 0.86 * 9.8,
        "attachment": 0.3, **WATER}  # fmt: skip
ARC = np.tan(3 * np.pi / 8)  # three quarters of a circle


def published(name):
    with open(ROOT / "tests" / "published" / name, encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if line[0] != "#")
        return [{key: float(value) for key, value in row.items()} for row in rows]


def cut_circle(diameter):
    """A circle without its lower quarter: three quarters of it on a flat bottom; the top, cut too, is in the air"""
    corner = diameter / 2 * np.exp(-0.25j * np.pi)
    return closed(np.array([corner, -corner.conjugate()]), (ARC, 0.0))


def rectangles(angle, line, periods):
    body = TautRectangle(angle=np.radians(angle), line=line, **BODY)
    waters = [section(0.6, 0.3, 0.6, 2 * np.pi / T, **WATER) for T in periods]
    return exact_response("taut", waters, body)


def of_angle(angle):
    """Periods and means over wave heights of transmission, front, back"""
    by_period = defaultdict(list)
    for row in published("breakwater_rectangle.csv"):
        if row["angle_deg"] == angle:
            by_period[row["period_s"]].append([row["transmission"], row["front"], row["back"]])
    return np.array(list(by_period)), np.array([np.mean(rows, axis=0) for rows in by_period.values()])


def tables():
    for angle in (44, 90, 158):
        periods, measured = of_angle(angle)

        def ours(line, angle=angle, periods=periods):
            made = rectangles(angle, line, periods)
            return np.abs([made.transmission, made.front / (9800 * 0.3), made.back / (9800 * 0.3)]).T

        def miss(line, ours=ours, measured=measured):
            return np.sqrt(np.mean((ours(line)[:, 0] - measured[:, 0]) ** 2))

        to_bed = 0.3 / np.sin(np.radians(angle))
        fitted = minimize_scalar(miss, bounds=(0.05, 1.5), method="bounded").x if angle == 90 else to_bed
        print(f"{angle}°: line to the bed {to_bed:.3f} m, taken {fitted:.3f} m; K_T, P_F, P_B over ρgad; measured")
        for T, row, other in zip(periods, ours(fitted), measured, strict=True):
            print(f"  {T:5.2f} s", *(f"{value:7.3f}" for value in (*row, *other)))
        print(f"  root mean square of K_T's difference {miss(fitted):.3f}; with the line to the bed {miss(to_bed):.3f}")
    print("Table 5.2, fixed: K_T, P_F, P_B over wHD, circle and cut circle; measured")
    shapes = (circle(0.5).wetted(0.35), cut_circle(0.5).wetted(0.16 + 0.25 * np.sqrt(0.5)))
    for row in published("breakwater_circles.csv"):
        print(f"  {row['period_s']:5.2f} s", end="")
        for wet, name in zip(shapes, ("circle", "cut"), strict=True):
            water = any_section(wet, 0.6, 2 * np.pi / row["period_s"], **WATER)
            made = exact_response("fixed", [water], None, np.pi / 4)
            ours = [abs(made.transmission[0]), *(abs(P[0]) / 2 / 9800 / 0.5 for P in (made.front, made.back))]
            other = [row[f"{name}_{part}"] for part in ("transmission", "front", "back")]
            print(" ", *(f"{value:6.3f}" for value in (*ours, *other)), end="")
        print()
    prototypes()
    tides()


def prototypes():
    """Table 4.4, circle of 10 m, and Table 6.2, the cut circle of 8.3 m in 10 m of water and waves of 3 m, in t/m"""
    print("Table 4.4, circle: K_T, P_F, P_B in kN/m per m of amplitude; measured")
    with open(ROOT / "pipelines" / "scenes" / "breakwater_circle.csv", encoding="utf-8") as file:
        rows = [list(map(float, row)) for row in list(csv.reader(line for line in file if line[0] != "#"))[1:]]
    for T, *measured in rows:
        water = any_section(circle(10.0).wetted(5.0), 10.0, 2 * np.pi / T, **WATER)
        made = exact_response("fixed", [water], None, np.pi / 4)
        ours = [abs(made.transmission[0]), abs(made.front[0]) / 1e3, abs(made.back[0]) / 1e3]
        print(f"  {T:5.1f} s", *(f"{value:7.2f}" for value in (*ours, *measured)))
    print("Table 6.2, cut circle: K_T, P_F, P_B in t/m; measured")
    wet = cut_circle(0.5).wetted(0.16 + 0.25 * np.sqrt(0.5))
    for row in published("breakwater_circles.csv"):
        made = exact_response("fixed", [any_section(wet, 0.6, 2 * np.pi / row["period_s"], **WATER)], None, np.pi / 4)
        ours = [abs(made.transmission[0]), *(abs(P[0]) / 2 / 9800 / 0.5 * 3 * 8.3 for P in (made.front, made.back))]
        measured = row["cut_transmission"], row["cut_front"] * 3 * 8.3, row["cut_back"] * 3 * 8.3
        print(f"  {row['period_s'] * np.sqrt(16.7):5.1f} s", *(f"{value:7.2f}" for value in (*ours, *measured)))


def tides():
    """Table 6.1, the circle of 10 m over the tide in waves of 3 m, its largest tensions up to 12 s, and what follows"""
    print("Table 6.1, P_F, P_B over wHD: long waves, potential flow; read from the paper's chart")
    rows, periods = published("breakwater_tide.csv"), np.arange(3.5, 12.001, 0.05)
    found = np.array([[_long_waves(row["tide_m"], periods), _potential(row["tide_m"], periods)] for row in rows])
    chart = np.array([[row["front"], row["back"]] for row in rows])
    for row, ours, read in zip(rows, found, chart, strict=True):
        print(f"  {row['tide_m']:+5.1f} m", *(f"{value:6.3f}" for value in (*ours.ravel(), *read)))
    part = 10.0 * 0.5 / (2 * np.sin(np.pi / 4))  # ρg = 1 t/m³
    sources = {"long waves": (found[:, 0], part), "potential flow": (found[:, 1], part), "chart": (chart, 3.5)}
    for name, (share, tide) in sources.items():
        front, back = 30 * share[:, 0], 30 * share[:, 1]
        needed = pretension_needed(front[0], tide)
        greatest = [needed + tide + wave for wave in (front[2], back[2])]
        print(f"  by {name}: P_0 {needed:.1f}, P_Fmax {greatest[0]:.1f}, P_Bmax {greatest[1]:.1f} t/m")


def _long_waves(tide, periods):
    body = fixed_body(*equal_area(10.0, 5.0 + tide), 10.0 + tide, 2 * np.pi / periods, **WATER)
    return [abs(P).max() / 2 / 98e3 for P in line_tensions(body.horizontal, body.vertical, np.pi / 4)]


def _potential(tide, periods):
    wet = circle(10.0).wetted(5.0 + tide)
    waters = [any_section(wet, 10.0 + tide, 2 * np.pi / T, **WATER) for T in periods]
    made = exact_response("fixed", waters, None, np.pi / 4)
    return [abs(P).max() / 2 / 98e3 for P in (made.front, made.back)]


def times():
    shapes = {"rectangle": rectangle(10, 7), "circle": circle(10), "cut circle": cut_circle(10)}
    for name, outline in shapes.items():
        wet = outline.wetted(5.0)
        shape.cache_clear()
        any_section(wet, 10.0, 0.9)
        begin = time.process_time()
        for omega in np.linspace(0.5, 1.5, 100):
            any_section(wet, 10.0, omega)
        print(f"{name}, panels: {10 * (time.process_time() - begin):.2f} ms for a period")
    section(10.0, 5.0, 10.0, 0.8)
    begin = time.process_time()
    for omega in np.linspace(0.5, 1.5, 100):
        section(10.0, 5.0, 10.0, omega)
    print(f"rectangle, eigenfunctions: {10 * (time.process_time() - begin):.2f} ms for a period")
    for name in ("rectangle", "circle"):
        begin = time.process_time()
        for draft in np.linspace(3.0, 6.0, 20):
            wet = shapes[name].wetted(draft)
            for T in np.linspace(4.0, 14.0, 200):
                any_section(wet, 10.0, 2 * np.pi / T)
        print(f"{name}, panels: {time.process_time() - begin:.1f} s for 200 periods and 20 drafts")


def losses():
    """C fitted to measured K_T; wave heights of Table 5.2 are not printed, 5 cm are taken"""
    for angle, line in ((44, 0.4319), (90, 0.205), (158, 0.8008)):
        rows = [row for row in published("breakwater_rectangle.csv") if row["angle_deg"] == angle]
        T, H, K = (np.array([row[key] for row in rows]) for key in ("period_s", "height_cm", "transmission"))
        _print_fit(f"rectangle, {angle}°", rectangles(angle, line, T), H / 200, K, T, Keel(0.3, 0.3, 0.6, 9.8))
    rows, wet = published("breakwater_circles.csv"), circle(0.5).wetted(0.35)
    T, K = (np.array([row[key] for row in rows]) for key in ("period_s", "circle_transmission"))
    made = exact_response("fixed", [any_section(wet, 0.6, w, **WATER) for w in 2 * np.pi / T], None, np.pi / 4)
    _print_fit("circle", made, np.full(len(T), 0.025), K, T, Keel(np.sqrt(0.0525), 0.35, 0.6, 9.8))


def moving_losses():
    """C fitted to measured K_T with the loss in the whole flow, and what it does to the tensions, over ρgad"""
    for angle, line in ((44, 0.4319), (90, 0.205), (158, 0.8008)):
        rows = [row for row in published("breakwater_rectangle.csv") if row["angle_deg"] == angle]
        measured = np.array([[row[key] for key in ("transmission", "front", "back")] for row in rows])
        body = TautRectangle(angle=np.radians(angle), line=line, **BODY)
        flows = {T: keel_flow(0.6, 0.3, 0.6, 2 * np.pi / T, **WATER) for T in {row["period_s"] for row in rows}}

        def ours(C, rows=rows, body=body, flows=flows):
            made = [response_with_loss("taut", [flows[r["period_s"]]], body, C, r["height_cm"] / 200) for r in rows]
            unit = np.array([1.0, 9800 * 0.3, 9800 * 0.3])
            return np.array([[abs(one.transmission[0]), abs(one.front[0]), abs(one.back[0])] for one in made]) / unit

        def misses(C, ours=ours, measured=measured):
            return np.sqrt(np.mean((ours(C) - measured) ** 2, axis=0))

        C = minimize_scalar(lambda C, misses=misses: misses(C)[0], bounds=(0, 30), method="bounded").x
        for one in (0.0, C):
            mean = ours(one).mean(axis=0)
            print(f"{angle}°, C {one:.2f}: K_T, P_F, P_B differ by", *np.round(misses(one), 3), "mean", *mean.round(3))


def fitted(response, amplitude, measured, omega, keel):
    """(C, root mean square of K_T's differences) that fits measured |K_T| (n,) best; amplitude : (n,) m"""

    def miss(coefficient):
        rows = [Response(*(values[i] for values in response)) for i in range(len(measured))]
        ours = [
            with_loss(row, coefficient, a, w, keel).transmission
            for row, a, w in zip(rows, amplitude, omega, strict=True)
        ]
        return np.sqrt(np.mean((np.abs(ours) - measured) ** 2))

    found = minimize_scalar(miss, bounds=(0.0, 100.0), method="bounded")
    return float(found.x), float(found.fun)


def _print_fit(name, made, amplitude, measured, T, keel):
    before = np.sqrt(np.mean((abs(made.transmission) - measured) ** 2))
    C, after = fitted(made, amplitude, measured, 2 * np.pi / T, keel)
    print(f"{name}: C {C:.2f}, root mean square of K_T's difference {before:.3f} without, {after:.3f} with loss")


def lengths():
    """Boxes of 10 x 5 m in 10 m of water, beam sea, by the contour method, per metre beside their section"""
    omega = 0.9
    there = section(10.0, 5.0, 10.0, omega)
    whole = there.added_mass + 1j * there.damping / omega
    print("length, m: relative difference of A + iB/ω in sway, heave, roll; of the forces")
    for length in (50.0, 100.0, 200.0, 400.0, 800.0):
        sizes = (length, 10.0, 5.0)
        body = ShapeProblem(method="contour", shape="box", sizes=sizes, depth=10.0, tolerance=1e-4).prepared()
        made = solve_frequency(body, omega, [np.pi / 2], {"added_mass", "radiation_damping", "excitation_force"})
        box = (made["added_mass"] + 1j * made["radiation_damping"] / omega).diagonal()[1:4] / length
        force = made["excitation_force"][0][1:4] / length
        misses = np.append(abs(box / whole.diagonal() - 1), abs(force / there.excitation - 1))
        print(f"  {length:5.0f}", *(f"{miss:9.5f}" for miss in misses))


def of_table_3_2(depth, draft, mass):
    """The circle on lines at 45° towards its centre, and what is wet of it"""
    wet, arm, z = circle(0.5).wetted(draft), 0.25 * np.sqrt(0.5), 0.25 - draft
    return TautBody(
        mass=mass, z0=z, inertia=0.04 * mass, area=wet.area, buoyancy_z=wet.center.imag, waterline=wet.waterline,
        draft=draft, depth=depth, angle=np.pi / 4, attachment=arm, attachment_z=z - arm,
        line=(depth + z - arm) * np.sqrt(2), **WATER,
    ), wet  # fmt: skip


def snaps():
    """Lines that go slack, of the stiffness that fits the front peaks best, which the paper does not print"""
    (taut, deep), (loose, wet) = of_table_3_2(0.5, 0.25, 57.4), of_table_3_2(0.4, 0.15, 49.5)
    rows, unit = published("breakwater_slack.csv"), 9800 * 0.5
    omegas, heights = (np.array([row[key] for row in rows]) for key in ("period_s", "slack_height_cm"))
    omegas, heights = 2 * np.pi / omegas, heights / 100
    waters = [[any_section(wet, 0.4, w, **WATER) for w in frequencies(loose, omega)] for omega in omegas]
    share = 9.8 / 0.235 / unit * 100
    measured = np.array(
        [[row[f"slack_{end}"] * share / row["slack_height_cm"] for end in ("front", "back")] for row in rows]
    )

    def ours(EA):
        each = zip(waters, omegas, heights, strict=True)
        return np.array([np.array(snap(loose, w, EA, o, H / 2).peaks) / unit / H for w, o, H in each])

    def miss(logarithm):
        return np.sqrt(np.mean((ours(10**logarithm) - measured)[:, 0] ** 2))

    best = minimize_scalar(miss, bounds=(3.0, 5.5), method="bounded", options={"xatol": 0.02})
    print(f"EA fitted to the front line {10**best.x:.3g} N per m, root mean square of its difference {best.fun:.2f}")
    for logarithm in (3.5, 4.0, 4.5, 5.0):
        print(f"  of {10**logarithm:.2g} N per m {miss(logarithm):.2f}")
    print("Table 3.2, front and back P/wHD, slack; measured; front, taut: ours, measured; slack over taut")
    for row, omega, found, other in zip(rows, omegas, ours(10**best.x), measured, strict=True):
        linear = abs(taut_exact(taut, any_section(deep, 0.5, omega, **WATER)).front) / 2 / unit
        beside = [linear, row["taut_front"] * share / row["taut_height_cm"], found[0] / linear]
        print(f"  {row['period_s']:5.2f} s", *(f"{value:6.2f}" for value in (*found, *other, *beside)))


if __name__ == "__main__":
    for asked in sys.argv[1:] or ("tables", "times", "snap", "loss", "moving", "length"):
        {"tables": tables, "times": times, "snap": snaps, "loss": losses, "moving": moving_losses, "length": lengths}[
            asked
        ]()
