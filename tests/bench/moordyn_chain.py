"""MoorDyn's side of `dynamic_lines.py`: one chain, fairlead in surge; prints one line of JSON.

python moordyn_chain.py ELEMENTS AMPLITUDE PERIOD DURATION        with a Python that has moordyn 2.7.2
"""

import json
import sys
import tempfile
import time
from pathlib import Path

import moordyn
import numpy as np

TEXT = """--- MoorDyn input ---
--- LINE TYPES ---
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
main 0.1368 114.94 4.933e8 -1.0 0.0 1.333 1.0 0.2034 0.5
--- POINTS ---
ID Type X Y Z M V CdA Ca
(#) (name) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed -290.0 0.0 -50.0 0 0 0 0
2 Coupled 0.0 0.0 0.0 0 0 0 0
--- LINES ---
ID LineType AttachA AttachB UnstrLen NumSegs Outputs
(#) (name) (#) (#) (m) (-) (-)
1 main 1 2 300.0 {elements} -
--- OPTIONS ---
1025 WtrDnsty
50 WtrDpth
9.80665 g
3.0e5 kbot
3.0e4 cbot
0.1 cfl
RK4 tScheme
2.0 dtIC
1e-5 threshIC
300 TmaxIC
0 writeLog
--- OUTPUTS ---
--- end ---
"""


def surge(t, amplitude, period):
    """Position and velocity of a sine that starts over one period."""
    x, omega = min(t / period, 1.0), 2 * np.pi / period
    ramp, rate = x**3 * (10 - 15 * x + 6 * x * x), 30 * x * x * (1 - x) ** 2 / period
    sine, cosine = np.sin(omega * t), np.cos(omega * t)
    return amplitude * ramp * sine, amplitude * (ramp * omega * cosine + rate * sine)


def main(elements, amplitude, period, duration, dt=0.02):
    file = Path(tempfile.mkdtemp()) / "chain.txt"
    file.write_text(TEXT.format(elements=elements), encoding="utf-8")
    system = moordyn.Create(str(file))
    begun = time.perf_counter()
    moordyn.Init(system, [0, 0, 0], [0, 0, 0])
    ready = time.perf_counter()
    line, count = moordyn.GetLine(system, 1), round(duration / dt)
    tension, force = [], []
    for i in range(count):
        x, v = surge(i * dt, amplitude, period)
        force.append(moordyn.Step(system, [x, 0, 0], [v, 0, 0], i * dt, dt)[0])
        tension.append(moordyn.GetLineFairTen(line))
    done = time.perf_counter()
    last = round(period / dt)
    at = (1 + np.arange(count)) * dt
    speed = np.array([surge(t, amplitude, period)[1] for t in at])
    found = dict(
        largest=max(tension[-last:]),
        least=min(tension[-last:]),
        work=-float(np.sum(np.array(force[-last:]) * speed[-last:])) * dt,
        start_ms=1e3 * (ready - begun),
        ms_per_second=1e3 * (done - ready) / duration,
    )
    print("\n" + json.dumps(found))


if __name__ == "__main__":
    main(int(sys.argv[1]), *map(float, sys.argv[2:5]))
