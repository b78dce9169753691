"""Results of one frequency on two meshes, extrapolated to panels of zero size (Richardson 1911).

The error of a mesh decreases with a known power of its number of panels (`bem.checks.ERROR_ORDER`). The difference
from a coarser mesh therefore shows most of the error, with its sign. After this error is subtracted, a sixth of the
error remains at the median of random bodies, and at most a third in nine bodies of ten. In short waves more remains:
with panels a fifth of a wave long, a third of the error at the median, and at most two thirds in nine bodies of ten
(`left_over`). Extrapolation takes no time, whereas twice as many panels, which leave 0.45 of the error, take three
times as long.
"""

import math
from functools import cached_property

from ..checks import share_left
from ..frequency import FrequencyRun

# errors left over, as shares of those of the mesh: in long waves, and more like the square of panels over waves, as
# errors of waves on panels are.  `python tests/bench/extrapolated.py` fits them: the worst errors of 400 scenes are
# within a factor of three of these shares in 94 %, of 400 others in 92 %, those of damping by its own size in 86 %
LEFT, OF_WAVES = 0.12, 4.0
# largest estimate of the remaining error, over the tolerance: of 358 frequencies beyond their tolerance 211 were
# extrapolated, and all of these met it
TRUSTED = 1 / 3


class ExtrapolatedRun(FrequencyRun):
    """A `bem.panels.one_frequency.PanelRun` whose results are extrapolated from two meshes.

    Every quantity that is linear in the potentials is extrapolated, and motions and drift forces follow from these
    quantities. `pressure` is not extrapolated.
    """

    def __init__(self, run):
        super().__init__(run.prepared, *run.question)
        self.run, self.wall_time = run, run.wall_time
        self.share = share_left(run.prepared.refinement)

    solves = True

    @property
    def refined(self):
        """The value of the original run"""
        return self.run.refined

    @property
    def sharper(self):
        return self.run.on_finer_mesh

    @cached_property
    def left_over(self):
        """Share of the mesh's error that remains after extrapolation"""
        return left_over(self.run.problem.mesh.sizes.max() * self.k / (2 * math.pi))

    @cached_property
    def radiation(self):
        return self._without_error("radiation")

    @cached_property
    def froude_krylov(self):
        return self._without_error("froude_krylov")

    @cached_property
    def diffraction(self):
        return self._without_error("diffraction")

    @cached_property
    def haskind(self):
        return None if self.run.haskind is None else self._without_error("haskind")

    @cached_property
    def kochin(self):
        return [H - error for H, error in zip(self.run.kochin, self.run.kochin_errors, strict=True)]

    @property
    def residual(self):
        """The larger of the residuals on the two meshes"""
        return max(self.run.residual, self.run.coarse.residual)

    @cached_property
    def differences(self):
        """Estimated errors of `radiation` and `excitation`"""
        return tuple(self.left_over * error for error in self.run.differences)

    @cached_property
    def kochin_errors(self):
        """Estimated errors of the Kochin functions"""
        return [self.left_over * error for error in self.run.kochin_errors]

    @cached_property
    def tolerances(self):
        """The largest estimated error, divided by a share of the tolerance"""
        return super().tolerances / TRUSTED

    def enlarged(self, radiation, excitation):
        """The value of the original run"""
        return self.run.enlarged(radiation, excitation)

    def drift_of_each(self, moving):
        """The value of the original run"""
        return self.run.drift_of_each(moving)

    def pressure(self):
        """The value of the original run"""
        return self.run.pressure()

    def _without_error(self, name):
        fine, rough = (getattr(run, name) for run in (self.run, self.run.coarse))
        return fine - self.share * (rough - fine)


def left_over(panels_per_wave):
    """Share of a mesh's error that remains after extrapolation; panels_per_wave : largest edge of a panel over the
    wavelength"""
    return min(1.0, LEFT + OF_WAVES * panels_per_wave**2)
