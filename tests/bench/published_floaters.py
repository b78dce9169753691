"""Four published floaters by commands alone, drawn from their dimensions: periods, and a decay that is known exactly.

    python tests/bench/published_floaters.py FOLDER [sphere] [spar] [semi] [float]

sphere  IEA-OES Task 10 (Wendt et al. 2017): radius 5 m, deep water; a decay from 1 m in heave and motions in regular
        waves, without and with a power take-off, against Hulme's hemisphere; targets 3 mm and 1 %
spar    OC3-Hywind (Jonkman, NREL/TP-500-47535, 2010) with its 5 MW turbine as a part of the body; periods 125, 31.2
        and 29.4 s of surge, heave and pitch (0.008, 0.032, 0.034 Hz), target 5 %
semi    OC4-DeepCwind (Robertson et al., NREL/TP-5000-60601, 2014) likewise, with its pontoons and braces; 107.5 s of
        surge and 113.6 of sway (0.0093 and 0.0088 Hz, one period by its symmetry), heave 17.3, pitch 26.8 s (0.0578,
        0.0373 Hz) of codes with an elastic tower.  Small motions have the period of sway: by the report's own matrices
        surge and sway are 113.6, pitch 25.4 s, which `by_its_own_matrices` prints beside.  Its lines stiffen: without
        damping a first swing from 15 m of surge lasts 109 to 110 s, one from 22 m 98 to 106 s, so that 107.5 s is that
        of a decay from afar. 5 200 panels: half an hour of processor
float   of RM3 (SAND2014-9040), 20 m with a hole of 6.5 m: that all three run; no period of it alone is published
"""

import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[2]))

from exact.hemisphere import HEAVE, hemisphere

G, RADIUS = 9.80665, 5.0
MASS = 2 / 3 * np.pi * RADIUS**3 * 1000.0
STIFFNESS = 1000.0 * G * np.pi * RADIUS**2
TAKE_OFF = {4.4: 322292.0, 6.0: 0.0}  # N s/m at a period, s; that of the report for the first

SPHERE = 'size = 0.4\nsymmetry = "xy"\n[[parts]]\nshape = "sphere"\ncenter = [0, 0, 0]\nradius = 5.0\n'
SPAR = """size = 2.5
symmetry = "xy"
[[parts]]
shape = "cylinder"
from = [0, 0, -120]
to = [0, 0, -12]
radius = 4.7
[[parts]]
shape = "cylinder"
from = [0, 0, -12]
to = [0, 0, -4]
radius = 4.7
end_radius = 3.25
[[parts]]
shape = "cylinder"
from = [0, 0, -4]
to = [0, 0, 10]
radius = 3.25
"""
SEMI = """size = 2.5
around = 12
symmetry = "y"
[[parts]]
shape = "cylinder"
from = [0, 0, -20]
to = [0, 0, 10]
radius = 3.25
[[parts]]
shape = "cylinder"
from = [-28.87, 0, -20]
to = [-28.87, 0, 12]
radius = 6.0
turns = 3
[[parts]]
shape = "cylinder"
from = [-28.87, 0, -20]
to = [-28.87, 0, -14]
radius = 12.0
turns = 3
"""
PIPE = """[[parts]]
shape = "cylinder"
from = {}
to = {}
radius = 0.8
"""


def pontoons():
    """Parts of OC4's lower pontoons and braces, 1.6 m thick: three outwards, three around, three that slope"""
    spread = [28.87 * np.array([np.cos(a), np.sin(a)]) for a in np.pi * np.array([1, 1 / 3, -1 / 3])]
    for i, out in enumerate(spread):
        for start, end in (
            ((0, 0, -17), (*out, -17)),
            ((*out, -17), (*spread[(i + 1) % 3], -17)),
            ((0, 0, -16.2), (*(23.87 / 28.87 * out), 9.13)),
        ):
            yield PIPE.format(*([round(float(value), 4) for value in place] for place in (start, end)))


def by_its_own_matrices():
    """(2,) s, OC4's periods of surge and pitch together: table 3-3, the turbine (TP-500-38060), eq. 4-3, eq. 5-15 and A
    at 27 s
    """
    parts = np.array([[1.3473e7, -13.46, 6.827e9], [249718.0, 43.4, 1.25e8], [350000.0, 89.56, 4.4e7]])  # kg, m, kg m²
    mass, first, second = (
        parts[:, 0].sum(),
        parts[:, 0] @ parts[:, 1],
        parts[:, 2].sum() + parts[:, 0] @ parts[:, 1] ** 2,
    )
    M = np.array([[mass, first], [first, second]]) + [[8.945e6, -1.104e8], [-1.104e8, 7.677e9]]
    C = np.array([[7.08e4, -1.08e5], [-1.08e5, 8.73e7 - 3.776e8 - first * G]])
    return 2 * np.pi / np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(M, C))))


FLOAT = """size = 1.2
symmetry = "xy"
[[parts]]
shape = "cylinder"
from = [0, 0, -2.58]
to = [0, 0, 2]
radius = 10.0
[[parts]]
shape = "cylinder"
from = [0, 0, -4]
to = [0, 0, 3]
radius = 3.25
cut = true
"""
SCENE = """[water]
depth = {depth}
density = {density}
[[bodies]]
shape = "mesh"
file = "{name}_hull.toml"
center_of_gravity = [0.0, 0.0, {cg}]
gyration = {gyration}
{mass}
[waves]
{omega}
headings_deg = [0, 45, 90, 135, 180]
"""
STUDY = """[water]
depth = {depth}
[hull]
freeboard = 10.0
[types.line]
weight_N_per_m = {weight}
axial_stiffness_kN = {stiffness}
{lines}
[waves]
height = 4.0
peak_period = 10.0
direction_deg = 0.0
[simulation]
duration = 600.0
linear_damping = {damping}
{spring}
"""
LINE = """[[lines]]
type = "line"
name = "{i}"
length = {length}
fairlead = [{x}, {y}, {z}]
anchor = [{u}, {v}]
"""
FLOATERS = {
    "spar": dict(
        hull=SPAR, depth=320.0, density=1025.0, cg=-78.0, gyration=[48.4, 48.4, 4.9], mass="mass = 8.066e6",
        omega="omegas = { from = 0.04, to = 1.6, count = 27 }", weight=698.094,
        stiffness=384243.0, length=902.2, anchor=853.87, fairlead=5.2, z=-70.0, headings=(0, 120, 240),
        damping="{ surge = 100.0, sway = 100.0, heave = 130.0, yaw = 13000.0 }", spring="spring = { yaw = 98340.0 }",
        periods={"surge": 125.0, "heave": 31.2, "pitch": 29.4},
    ),
    "semi": dict(
        hull=SEMI + "".join(pontoons()), depth=200.0, density=1025.0, cg=-9.89, gyration=[28.4, 28.4, 29.6],
        mass="mass = 1.4073e7", omega="omegas = { from = 0.05, to = 1.25, count = 17 }", weight=1065.3,
        stiffness=753600.0, length=835.5, anchor=837.6, fairlead=40.868, z=-14.0, headings=(60, 180, 300),
        damping="{ surge = 50.0, heave = 50.0, roll = 1e5, pitch = 1e5 }", spring="",
        periods={"surge": 107.5, "sway": 113.6, "heave": 17.3, "pitch": 26.8},
    ),
    "float": dict(
        hull=FLOAT, depth=70.0, density=1025.0, cg=-0.72, gyration=[5.36, 5.41, 7.14], mass="",
        omega="omegas = { from = 0.2, to = 3.0, count = 29 }", weight=500.0,
        stiffness=100000.0, length=240.0, anchor=240.0, fairlead=9.0, z=0.0, headings=(0, 120, 240),
        damping="{ surge = 10.0 }", spring="", periods={},
    ),
}  # fmt: skip


def run(folder, *words):
    """Whether a command ended with 0 or 1; what it said is in a file beside its results"""
    done = subprocess.run(
        [sys.executable, "-m", "hakobune", *words], cwd=folder, capture_output=True, text=True, check=False
    )
    (folder / f"{words[0]}_{Path(words[1]).stem}.txt").write_text(done.stdout + done.stderr, encoding="utf-8")
    print("hakobune", *words, "->", done.returncode, done.stderr.strip()[-300:] if done.returncode > 1 else "")
    return done.returncode < 2


def floater(folder, name):
    about = FLOATERS[name]
    (folder / f"{name}_hull.toml").write_text(about["hull"])
    (folder / f"{name}.toml").write_text(SCENE.format(name=name, **about))
    lines = []
    for i, degrees in enumerate(about["headings"]):
        way = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
        (x, y), (u, v) = about["fairlead"] * way, about["anchor"] * way
        lines.append(LINE.format(i=i, x=x, y=y, u=u, v=v, **about))
    (folder / f"{name}_study.toml").write_text(STUDY.format(lines="".join(lines), **about))
    run(folder, "solve", f"{name}.toml", "--output", f"{name}.h5")
    if run(folder, "moor", f"{name}_study.toml", "--database", f"{name}.h5", "--output", f"{name}_moor.h5"):
        with h5py.File(folder / f"{name}_moor.h5") as f:
            periods = dict(zip(map(bytes.decode, f["mode"][()]), f["period.at_rest"][()], strict=True))
        for motion, period in periods.items():
            other = about["periods"].get(motion)
            print(
                f"  {motion} {period:.2f} s",
                f"published {other} s, {100 * (period / other - 1):+.1f} %" if other else "",
            )
    if name == "semi":
        print("  by the report's matrices: surge and sway {:.1f}, pitch {:.1f} s".format(*by_its_own_matrices()))
    run(folder, "simulate", f"{name}_study.toml", "--database", f"{name}.h5", "--output", f"{name}_run.h5")


def coefficients(omega):
    """Added mass kg and damping N s/m of heave, by Hulme"""
    displaced = 2 / 3 * np.pi * RADIUS**3 * 1000.0
    A, B = np.array([hemisphere(w * w * RADIUS / G, HEAVE) for w in omega]).T
    return displaced * A, displaced * omega * B


def exact_decay(time, offset):
    """m: x = 2/π ∫ Re X cos ωt dω with X = x₀ (iω(M + A) + B) / (C − ω²(M + A) + iωB), at rest before"""
    omega = np.linspace(0.01, 6.0, 600)
    A, B = coefficients(omega)
    inertia = MASS + A
    X = offset * (1j * omega * inertia + B) / (STIFFNESS - omega**2 * inertia + 1j * omega * B)
    return np.array([2 / np.pi * np.trapezoid(X.real * np.cos(omega * t), omega) for t in time])


def sphere(folder):
    (folder / "sphere_hull.toml").write_text(SPHERE)
    scene = SCENE.format(
        name="sphere", depth="inf", density=1000.0, cg=-2.0, gyration=[3.0, 3.0, 3.0], mass="",
        omega="omegas = { from = 0.2, to = 4.0, count = 39 }",
    )  # fmt: skip
    (folder / "sphere.toml").write_text(scene)
    run(folder, "solve", "sphere.toml", "--output", "sphere.h5")
    hull = "[water]\ndepth = inf\n[hull]\nfreeboard = 5.0\n"
    still = "[simulation]\nmotions = ['heave']\nduration = 40.0\nramp = 0.0\nstep = 0.05\noffset = { heave = 1.0 }\n"
    (folder / "decay.toml").write_text(hull + still)
    if run(folder, "simulate", "decay.toml", "--database", "sphere.h5", "--output", "decay.h5"):
        time, heave = record(folder / "decay.h5")
        print(f"  decay from 1 m: {1e3 * np.abs(heave - exact_decay(time, 1.0)).max():.2f} mm off, limit 3")
    for period, damping in [(T, b) for T, most in TAKE_OFF.items() for b in dict.fromkeys((0.0, most))]:
        name, omega = f"regular_{period:g}_{damping:g}", 2 * np.pi / period
        waves = f"[waves]\nheight = 0.2\nperiod = {period}\ndirection_deg = 0.0\nmethod = 'regular_wave'\n"
        more = f"[simulation]\nmotions = ['heave']\nduration = {20 * period}\nramp = 100.0\nstep = 0.05\n"
        more += f"linear_damping = {{ heave = {damping / 1e3} }}\n"
        (folder / f"{name}.toml").write_text(hull + waves + more)
        if run(folder, "simulate", f"{name}.toml", "--database", "sphere.h5", "--output", f"{name}.h5"):
            _, heave = record(folder / f"{name}.h5")
            A, B = (value[0] for value in coefficients(np.array([omega])))
            force = np.sqrt(2 * 1000.0 * G**3 * B / omega**3)  # Haskind's relation for a round body
            exact = force / abs(STIFFNESS - omega**2 * (MASS + A) + 1j * omega * (B + damping))
            found = np.sqrt(2) * heave.std() / 0.1
            print(f"  {period} s, take-off {damping:g}: {found:.4f} m/m, {100 * (found / exact - 1):+.2f} % off")


def record(path):
    """Time s and heave m of the first run"""
    with h5py.File(path) as f:
        return f["time"][()], f["motion"][0, :, 2].astype(float)


if __name__ == "__main__":
    place = Path(sys.argv[1]).absolute()
    place.mkdir(parents=True, exist_ok=True)
    for word in sys.argv[2:] or ("sphere", *FLOATERS):
        sphere(place) if word == "sphere" else floater(place, word)
