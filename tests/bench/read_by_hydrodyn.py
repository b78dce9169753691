"""HydroDyn run on our export: forces of a regular wave and of a forced motion beside those of the database.

    python tests/bench/read_by_hydrodyn.py --driver PATH

PATH is OpenFAST's `hydrodyn_driver` (built of the development branch of 2026; double precision).  A box of
100 × 50 × 10 m in 20 m of water is solved and exported with `--to wamit`.  In a regular wave the fixed body has the
force X η₀; in a forced motion x₀ cos ωt it has F = (ω²A + iωB) x₀, with A = A_∞ plus the memory that HydroDyn
integrates itself out of B over its frequencies.  Phases of HydroDyn are those of exp(+iωt), its wave
has its crest at the origin at t = 0.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from hakobune.bem.database import open_database
from hakobune.pipelines.cli import main

BOX = "--length 100 --beam 50 --draft 10 --depth 20 --gyration 15.6,29.4,32.3 --omega 0.05:4:80 --heading 0:180:7"
DEPTH, DENSITY, GRAVITY, VOLUME = 20.0, 1025.0, 9.80665, 50000.0
LONG = 80 * np.pi  # s, so that waves of 0.4, 0.8 and 1.2 rad/s have whole cycles in it
STEP = LONG / 20480  # s; the memory of HydroDyn lags by one
OMEGAS = (0.4, 0.8, 1.2)  # rad/s, of those solved
PUSHED = (0, 2, 4)  # surge, heave, pitch
NAMES = ("B1WvsF1xi", "B1WvsF1yi", "B1WvsF1zi", "B1WvsM1xi", "B1WvsM1yi", "B1WvsM1zi")
MADE = tuple(name.replace("Wvs", "Rdt").replace("1", "", 2).replace("B", "B1") for name in NAMES)


def rows(*pairs):
    return [f"{value}  {name}" for value, name in pairs]


def hydrodyn(root):
    """Primary input: one body of a WAMIT set, no members"""
    six = [" ".join(["0"] * 6)] * 6
    head = rows(
        (1, "PotMod"), (1, "ExctnMod"), (0, "ExctnDisp"), (10, "ExctnCutOff"), (0, "PtfmYMod"), (0, "PtfmRefY"),
        (0.01, "PtfmYCutOff"), (36, "NExctnHdg"), (1, "RdtnMod"), (60, "RdtnTMax"), ("DEFAULT", "RdtnDT"), (1, "NBody"),
        (1, "NBodyMod"), (f'"{root}"', "PotFile"), (1, "WAMITULEN"), (0, "PtfmRefxt"), (0, "PtfmRefyt"),
        (0, "PtfmRefzt"), (0, "PtfmRefztRot"), (VOLUME, "PtfmVol0"), (0, "PtfmCOBxt"), (0, "PtfmCOByt"),
        (0, "NAddDOF"),
    )  # fmt: skip
    drift = rows((0, "MnDrift"), (0, "NewmanApp"), (0, "DiffQTF"), (0, "SumQTF"))
    more = ["0  AddF0", *["0"] * 5, *six, *six, *six]
    strip = rows((0, "WaveDisp"), (0, "AMMod"), (0, "HstMod"))
    none = [
        "---", "0 NAxCoef", "-", "-", "---", "0 NJoints", "-", "-", "---", "0 NPropSetsCyl", "-", "-",
        "---", "0 NPropSetsRec", "-", "-", "---", "-", "-", " ".join(["0"] * 14), "---", "-", "-", " ".join(["0"] * 20),
        "---", "0 NCoefDpthCyl", "-", "-", "---", "0 NCoefDpthRec", "-", "-", "---", "0 NCoefMembersCyl", "-", "-",
        "---", "0 NCoefMembersRec", "-", "-", "---", "0 NMembers", "-", "-", "---", "0 NFillGroups", "-", "-",
        "---", "0 NMGDepths", "-", "-", "---", "0 NMOutputs", "-", "-", "---", "0 NJOutputs", "0 JOutLst",
    ]  # fmt: skip
    out = ["---", *rows(("False", "HDSum"), ("False", "OutAll"), (1, "OutSwtch"), ('"E16.8e2"', "OutFmt"))]
    out += ['"A15" OutSFmt', "---", *NAMES, *MADE, "END"]
    return "\n".join(["HydroDyn", "box", "False Echo", "---", *head, "---", *drift, "---", *more, "---", *strip, *none,
                      *out, ""])  # fmt: skip


def seastate(height, period):
    """A regular wave whose crest is at the origin at t = 0, along x; still water where its height is 0"""
    head = ["SeaState", "sea", "False Echo", "---", "DEFAULT WtrDens", "DEFAULT WtrDpth", "DEFAULT MSL2SWL", "---"]
    head += rows((20, "X_HalfWidth"), (20, "Y_HalfWidth"), (DEPTH, "Z_Depth"), (3, "NX"), (3, "NY"), (3, "NZ"))
    waves = rows(
        ("1P0" if height else 0, "WaveMod"), (0, "WaveStMod"), (0, "WvCrntMod"), (LONG, "WaveTMax"), (STEP, "WaveDT"),
        (height, "WaveHs"), (period, "WaveTp"), ("DEFAULT", "WavePkShp"), (0.0, "WvLowCOff"), (60, "WvHiCOff"),
        (0, "WaveDir"), (0, "WaveDirMod"), (1, "WaveDirSpread"), (1, "WaveNDir"), (0, "WaveDirRange"),
        (1, "WaveSeed(1)"), (2, "WaveSeed(2)"), ("False", "WaveNDAmp"), ('"none"', "WvKinFile"),
    )  # fmt: skip
    second = rows(("False", "WvDiffQTF"), ("False", "WvSumQTF"), (0, "WvLowCOffD"), (3, "WvHiCOffD"),
                  (0, "WvLowCOffS"), (3, "WvHiCOffS"))  # fmt: skip
    crest = rows((0, "ConstWaveMod"), (1, "CrestHmax"), (60, "CrestTime"), (0, "CrestXi"), (0, "CrestYi"))
    current = rows((0, "CurrMod"), (0, "CurrSSV0"), ("DEFAULT", "CurrSSDir"), (20, "CurrNSRef"), (0, "CurrNSV0"),
                   (0, "CurrNSDir"), (0, "CurrDIV"), (0, "CurrDIDir"))  # fmt: skip
    out = rows(("False", "SeaStSum"), (2, "OutSwtch"), ('"E16.8e2"', "OutFmt"), ('"A15"', "OutSFmt"),
               (1, "NWaveElev"), (0, "WaveElevxi"), (0, "WaveElevyi"), (0, "NWaveKin"), (0, "WaveKinxi"),
               (0, "WaveKinyi"), (0, "WaveKinzi"))  # fmt: skip
    parts = (head, waves, second, crest, current, ["0 MCFD"], out, ["Wave1Elev", "END"])
    return "\n".join("\n---\n".join("\n".join(part) for part in parts).splitlines()) + "\n"


def driver(name, steps, pushed):
    zeros = ", ".join(["0"] * 6)
    return "\n".join([
        "HydroDyn driver", "box", "False Echo", "---",
        *rows((GRAVITY, "Gravity"), (DENSITY, "WtrDens"), (DEPTH, "WtrDpth"), (0, "MSL2SWL")), "---",
        *rows((f'"{name}.dat"', "HDInputFile"), (f'"{name}_sea.dat"', "SeaStateInputFile")),
        *rows((f'"{name}"', "OutRootName"), ("False", "Linearize"), (steps, "NSteps"), (STEP, "TimeInterval")), "---",
        *rows((2 if pushed else 0, "PRPInputsMod"), (0, "NAddDOF"), (0, "PtfmRefzt")),
        *rows((f'"{name}_motion.dat"', "PRPInputsFile")), "---",
        zeros + " uPRPInSteady", zeros + " uDotPRPInSteady", zeros + " uDotDotPRPInSteady", "",
    ])  # fmt: skip


def run(path, folder, name, height=0.0, omega=1.0, mode=None, size=0.0):
    """{channel: the complex amplitude of exp(iωt)} of a run"""
    steps = round(LONG / STEP)
    (folder / f"{name}.dat").write_text(hydrodyn("box"))
    (folder / f"{name}_sea.dat").write_text(seastate(height, 2 * np.pi / omega))
    (folder / f"{name}.dvr").write_text(driver(name, steps, mode is not None))
    if mode is not None:
        t = STEP * np.arange(steps + 2)
        table = np.zeros((len(t), 19))
        table[:, 0] = t
        table[:, 1 + mode], table[:, 7 + mode] = size * np.cos(omega * t), -size * omega * np.sin(omega * t)
        table[:, 13 + mode] = -size * omega**2 * np.cos(omega * t)
        np.savetxt(folder / f"{name}_motion.dat", table, fmt="%.9e")
    done = subprocess.run([path, f"{name}.dvr"], cwd=folder, capture_output=True, text=True, check=False)
    found = folder / f"{name}.HD.out"
    if not found.exists():
        sys.exit(f"hydrodyn_driver: {' '.join((done.stdout + done.stderr).split())[-900:]}")
    lines = found.read_text().splitlines()
    start = next(i for i, line in enumerate(lines) if line.split()[:1] == ["Time"])
    data = np.array([[float(word) for word in line.split()] for line in lines[start + 2 :]])
    series = dict(zip(lines[start].split(), data.T, strict=True))
    return {channel: at(series["Time"], values, omega) for channel, values in series.items()}


def at(t, values, omega):
    """The complex amplitude of exp(iωt) over the last third"""
    last = t > 2 / 3 * t[-1]
    basis = np.stack([np.cos(omega * t[last]), np.sin(omega * t[last]), np.ones(last.sum())], axis=1)
    c, s, _ = np.linalg.lstsq(basis, values[last], rcond=None)[0]
    return c - 1j * s


def campaign(path):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if main(["box", *BOX.split(), "--output", str(folder / "box.h5")]):
            return 1
        main(["export", str(folder / "box.h5"), "--to", "wamit"])
        db = open_database(folder / "box.h5")
        ahead = int(np.argmin(np.abs(db.wave_direction)))
        print(
            "ω rad/s | force of the wave in surge, heave, pitch off | A + iB/ω of surge, heave, pitch off: as it is, "
            "its memory a step earlier"
        )
        for omega in OMEGAS:
            i = int(np.argmin(np.abs(db.omega - omega)))
            row = {name: db[name][i] for name in ("added_mass", "radiation_damping", "excitation_force")}
            row["added_mass_infinity"] = db["added_mass_infinity"]
            X = row["excitation_force"][ahead]
            print(f"{omega:.4g}", in_waves(path, folder, omega, X), pushed(path, folder, omega, row), sep=" | ")
    return 0


def in_waves(path, folder, omega, X):
    found = run(path, folder, f"w{omega}", height=2.0, omega=omega)
    forces = np.array([found[name] for name in NAMES])
    return " ".join(f"{100 * abs(forces[i] - np.conj(X[i])) / abs(X[i]):.3f} %" for i in PUSHED)


def pushed(path, folder, omega, row):
    """What A + iB/ω differs by, over its size: as it is, and with the memory one step earlier

    F = ω²(A − iB/ω) x₀ of exp(+iωt)
    """
    said = []
    for mode in PUSHED:
        size = 0.01 if mode > 2 else 1.0
        made = run(path, folder, f"m{omega}_{mode}", omega=omega, mode=mode, size=size)[MADE[mode]] / size / omega**2
        ours = row["added_mass"][mode, mode] - 1j * row["radiation_damping"][mode, mode] / omega
        still = row["added_mass_infinity"][mode, mode]
        earlier = still + (made - still) * np.exp(1j * omega * STEP)
        said.append(" ".join(f"{100 * abs(one - ours) / abs(ours):.2f}" for one in (made, earlier)))
    return ", ".join(said) + " %"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--driver", required=True)
    sys.exit(campaign(parser.parse_args().driver))
