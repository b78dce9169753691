"""Distribution of approach speeds.

    P(speed > v) = exp(−(v/η)^m),    f = (m v^{m−1}/t₀) exp(−v^m/t₀),  t₀ = η^m

(Weibull; Ueda 1981, eq. 4.1, whose printed constants contradict its mean and are not used.)  The speed of a return
period is exceeded once in its number of contacts: 50 ships a year with two contacts each make 1000 contacts in 10
years.
"""

import math
from typing import NamedTuple

from .energy import BerthingError

LARGEST = 100.0  # m, exponent


class Speeds(NamedTuple):
    """scale : η m/s; shape : m"""

    scale: float
    shape: float

    @property
    def mean(self):
        """m/s"""
        return self.scale * math.gamma(1 + 1 / self.shape)

    @property
    def deviation(self):
        """m/s"""
        return self.scale * math.sqrt(math.gamma(1 + 2 / self.shape) - math.gamma(1 + 1 / self.shape) ** 2)

    def exceeded(self, speed):
        """Probability that a contact is faster than `speed`, m/s"""
        return math.exp(-((max(speed, 0.0) / self.scale) ** self.shape))

    def speed_of(self, contacts):
        """Speed, m/s, exceeded once in `contacts` contacts. Raises BerthingError."""
        if not 1 < contacts < math.inf:
            raise BerthingError(
                f"the speed that is exceeded once in {contacts:g} contacts is requested; allowed: above 1 contact, "
                "finite"
            )
        return self.scale * math.log(contacts) ** (1 / self.shape)


def speeds_of_moments(mean, deviation):
    """`Speeds` with mean and standard deviation, m/s.  Raises BerthingError."""
    for key, value in (("mean", mean), ("deviation", deviation)):
        if not 0 < value < math.inf:
            raise BerthingError(f"the {key} of the speeds is {value:g} m/s; allowed: above 0, finite")
    low, high = 0.2, LARGEST  # the ratio falls with the exponent
    ratios = [Speeds(1.0, m).deviation / Speeds(1.0, m).mean for m in (high, low)]
    if not ratios[0] <= deviation / mean <= ratios[1]:
        raise BerthingError(
            f"the standard deviation of the speeds over their mean is {deviation / mean:.3g}; allowed: "
            f"{ratios[0]:.2g} to {ratios[1]:.3g}"
        )
    for _ in range(80):
        middle = 0.5 * (low + high)
        made = Speeds(1.0, middle)
        low, high = (middle, high) if made.deviation / made.mean > deviation / mean else (low, middle)
    return Speeds(mean / math.gamma(1 + 1 / low), low)
