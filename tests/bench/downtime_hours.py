"""350 000 hours of a made-up hindcast through a body's linear responses: time, memory, and hours one by one beside.

    python tests/bench/downtime_hours.py box.h5 [--years 40] [--hours 200]

Hours one by one are `mooring.response.sea_state.linear_response` over the same frequencies, at the very direction of
the hour (long crests) or over headings every half degree (spread), and over twice as many frequencies; and `sea_state`
whole, whose frequencies are of each sea.
"""

from __future__ import annotations

import argparse
import os
import resource
import sys
import time
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.signal import lfilter

sys.path.insert(0, str(Path(__file__).parents[2]))

from hakobune.bem.database import open_database
from hakobune.mooring.downtime.every_hour import Shape, moments_of_hours, response_of
from hakobune.mooring.downtime.hindcast import WaveHours
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import jonswap
from hakobune.mooring.environment.spreading import CosinePower, Mitsuyasu
from hakobune.mooring.response.linear import subdivided
from hakobune.mooring.response.points import Point, transfer_functions
from hakobune.mooring.response.sea_state import linear_response, sea_state
from hakobune.mooring.response.seas import directions

POINTS = [Point("bow", (50.0, 0.0, 10.0))]
NAMES = ("surge", "sway", "heave", "roll", "pitch", "yaw", "bow displacement z", "bow velocity z", "bow acceleration x",
         "bow acceleration y", "bow acceleration z", "bow relative elevation")  # fmt: skip


def weather(years, seed=1):
    """WaveHours of hours with memory; directions are any numbers"""
    rng, n = np.random.default_rng(seed), int(years * 8766)

    def noise(hours):
        a = np.exp(-1 / hours)
        return lfilter([np.sqrt(1 - a * a)], [1, -a], rng.standard_normal(n + 1000))[1000:]

    x = noise(36.0)
    period = np.clip(8.5 + 1.2 * x + 1.6 * noise(48.0), 5.0, 16.0)
    return WaveHours(np.exp(-0.4 + 0.45 * x), period, np.mod(1.0 + 0.8 * noise(48.0), 2 * np.pi))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("database")
    parser.add_argument("--years", type=float, default=40.0)
    parser.add_argument("--hours", type=int, default=200)
    asked = parser.parse_args()
    body = open_database(asked.database).reader.floating()
    damping = np.zeros((6, 6))
    damping[3, 3] = 0.05 * body.critical_damping(3)
    body, waves = body.restrained(damping), weather(asked.years)
    chosen = np.random.default_rng(2).choice(len(waves.height), asked.hours, replace=False)
    for spreading in (None, CosinePower(4.0), Mitsuyasu(25.0, 1.0)):
        shape, begun = Shape("jonswap", "peak_period", None, spreading), clocks()
        response = response_of(body, POINTS, NAMES)
        between = clocks()
        m0, _ = moments_of_hours(response, shape, waves)
        (wall, own), (later, later_own) = between - begun, clocks() - between
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20
        print(f"{len(m0)} hours, {m0.shape[1]} quantities, spreading {spreading}: {wall:.1f} s of transfer functions, "
              f"{later:.1f} s of hours; processor {own:.1f} and {later_own:.1f} s, {memory:.2f} GiB, load "
              f"{os.getloadavg()[0]:.1f}", flush=True)  # fmt: skip
        largest = np.sqrt(m0[chosen].max(axis=0))
        away = {"one by one": 0.0, "twice the frequencies": 0.0, "sea_state, itself": 0.0}
        for hour in chosen:
            spectrum = jonswap(waves.height[hour], peak_period=waves.period[hour])
            own = spreading
            if isinstance(spreading, Mitsuyasu):
                own = replace(spreading, peak_omega=spectrum.peak_omega)
            sea = Sea(spectrum, waves.direction[hour], own)
            same = one_hour(body, sea, response.omega)
            finer = one_hour(body, sea, subdivided(response.omega, 2))
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                state = sea_state(body, sea, 3600.0, POINTS)
            whole = np.sqrt(state.moments.m0[[state.names.index(name) for name in NAMES]])
            found = np.sqrt(m0[hour])
            for name, difference in (
                ("one by one", found - same),
                ("twice the frequencies", found - finer),
                ("sea_state, itself", whole - finer),
            ):
                away[name] = np.maximum(away[name], np.abs(difference) / largest)
        for name, values in away.items():
            print(
                f"  σ beside {name}, {asked.hours} hours, of its largest: {values.max():.1e} ({NAMES[values.argmax()]})"
            )


def clocks():
    """(2,) s of the wall and of the processor"""
    return np.array([time.perf_counter(), time.process_time()])


def one_hour(body, sea, omega):
    """(12,) σ of an hour alone, at frequencies omega (q,) rad/s"""
    heading, weights = directions(sea, omega, 0.5)
    transfer = transfer_functions(body, omega, heading, POINTS)
    return np.sqrt(linear_response(sea, transfer, weights)[1].m0[[transfer.names.index(name) for name in NAMES]])


if __name__ == "__main__":
    main()
