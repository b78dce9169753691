"""Loads on a body in time, and settings of a run."""

from dataclasses import dataclass

import numpy as np

from ..environment.sea import Sea
from ..environment.spectra import issc
from ..on_current.waves import carrier_of
from ..seas.systems import Systems

DYNAMIC_WATER = ("still", "sea")
SLOW_DRIFT = ("newman", "half-waves", "mean", "none")
MOST_ELEMENTS = 1000
MEMORY = ("states", "constant")


@dataclass(frozen=True)
class Weather:
    """All loads on a body except its lines; None or empty for an absent load.

    seas : tuple of `mooring.environment.sea.Sea`, long- or short-crested
    regular : regular waves (`mooring.studies.conditions.Waves`), in place of seas
    wind, current : `mooring.studies.conditions.Wind` and `Current`; gusts : `mooring.environment.gusts.GustSpectrum`
    forces : tuple of `mooring.motion.given_forces.GivenForce`
    beside_newman : for each sea, forces of wave pairs from `mooring.response.pair_levels.beside_newman`, on the body
        at its position and heading at rest; None where Newman's approximation suffices
    on_hull : `mooring.motion.tables.hull_water.OnHull`, with its current, in place of the hull and current of a box
    components : `mooring.environment.sea.Components` in place of seas, equal for every seed, for example of a
        measured record. Time is counted from the start of the ramp; frequencies are those in the moving water
    carrier : `mooring.on_current.waves.Carrier` of the waves, by default the Carrier of `current`
    """

    seas: tuple = ()
    regular: object = None
    wind: object = None
    gusts: object = None
    current: object = None
    forces: tuple = ()
    beside_newman: tuple = ()
    components: object = None
    on_hull: object = None
    carrier: object = None

    @property
    def waves(self):
        """All waves as one object for frequency-domain studies: a Sea, `Systems` or regular `Waves`; None without
            waves.

        Components are replaced by an ISSC spectrum with their energy, mean frequency and mean direction.
        """
        if self.seas:
            return self.seas[0] if len(self.seas) == 1 else Systems(self.seas)
        if self.components is None:
            return self.regular
        omega, amplitude, _, direction = self.components
        energy = 0.5 * np.square(amplitude)
        spectrum = issc(4 * np.sqrt(energy.sum()), mean_period=2 * np.pi * energy.sum() / (energy @ omega))
        return Sea(spectrum, float(np.angle(energy @ np.exp(1j * np.asarray(direction)))))

    def __post_init__(self):
        if self.carrier is None:
            object.__setattr__(self, "carrier", carrier_of(self.current))
        object.__setattr__(self, "seas", tuple(self.seas))
        object.__setattr__(self, "forces", tuple(self.forces))
        if sum((bool(self.seas), self.regular is not None, self.components is not None)) > 1:
            raise ValueError("weather has more than one of seas, a regular wave and a record; give one of them")
        object.__setattr__(self, "beside_newman", tuple(self.beside_newman))
        if self.beside_newman and len(self.beside_newman) != len(self.seas):
            raise ValueError(
                f"weather has {len(self.beside_newman)} forces of wave pairs (beside_newman) and {len(self.seas)} "
                "seas; allowed: one force for each sea"
            )
        if self.gusts is not None and self.wind is None:
            raise ValueError("weather has gusts but no wind; give the mean wind")


@dataclass(frozen=True)
class Settings:
    """Settings of a run.

    duration : duration of the statistics, s; ramp : time before the duration, in which every load grows from zero, s
    wave_ramp : start of the waves, and duration of their growth, (s, s); None for the ramp of all loads
    step : time between stored samples, s; tolerance : tolerance of the motions, relative to their standard deviations
    components : number of wave components of each sea, None to choose it by duration and bandwidth
    slow_drift : "newman", "half-waves" (the report's), "mean" or "none"
    wave_drift_damping : whether slow velocities change the drift
    memory : "states", or "constant" for added mass and damping at one frequency (the report's variant)
    constant_period : period of that frequency, s, None for the mean period of the waves
    dynamic_lines : names of dynamic lines, "all", "none", or "auto" for all if a trial shows the need; all other
        lines have their static shape
    dynamic_elements : number of elements of each dynamic line
    dynamic_water : water around dynamic lines: "still", or "sea" for waves and current
    lines_lost : (name, time of the break from the end of the ramp, s) of lines that break
    fixed_step : step of integration without control of the error, s; None to control the error
    estimate_error : whether a second run at a tenth of the tolerance estimates the error; if the two differ by more
        than a third of the tolerance, a third run at a hundredth follows
    offset, velocity : initial displacement from the equilibrium, and initial velocity, (6,), m, rad and m/s, rad/s
    """

    duration: float
    ramp: float = 200.0
    step: float = 0.5
    tolerance: float = 1e-3
    components: int | None = None
    slow_drift: str = "newman"
    wave_drift_damping: bool = True
    memory: str = "states"
    constant_period: float | None = None
    dynamic_lines: tuple[str, ...] | str = ()
    dynamic_elements: int = 20
    dynamic_water: str = "still"
    lines_lost: tuple[tuple[str, float], ...] = ()
    fixed_step: float | None = None
    estimate_error: bool = False
    wave_ramp: tuple[float, float] | None = None
    offset: tuple[float, ...] = (0.0,) * 6
    velocity: tuple[float, ...] = (0.0,) * 6

    def __post_init__(self):
        for name, low in (("duration", 0.0), ("step", 0.0), ("tolerance", 0.0)):
            value = getattr(self, name)
            if not low < value < float("inf"):
                raise ValueError(f"{name} is {value:g}; allowed: above 0, finite")
        if not 0 <= self.ramp < float("inf"):
            raise ValueError(f"ramp is {self.ramp:g} s; allowed: at least 0")
        if self.tolerance > 0.1:
            raise ValueError(f"tolerance is {self.tolerance:g}; allowed: above 0, at most 0.1")
        for name, words in (("slow_drift", SLOW_DRIFT), ("memory", MEMORY), ("dynamic_water", DYNAMIC_WATER)):
            if getattr(self, name) not in words:
                raise ValueError(f"{name} is {getattr(self, name)!r}; allowed: {', '.join(words)}")
        if self.constant_period is not None and not (self.memory == "constant" and 0 < self.constant_period < 1e6):
            raise ValueError(
                f'constant_period is {self.constant_period:g} s with memory = "{self.memory}"; allowed: above 0, with '
                'memory = "constant"'
            )
        if not 2 <= self.dynamic_elements <= MOST_ELEMENTS:
            raise ValueError(f"dynamic_elements is {self.dynamic_elements}; allowed: 2 to {MOST_ELEMENTS}")
        if self.components is not None and not (self.components == int(self.components) and self.components >= 1):
            raise ValueError(f"components is {self.components}; allowed: a whole number from 1")
