"""Linear waves and a floating body, one frequency at a time: radiation, diffraction, mean drift, motions.

Conventions, the same everywhere in this package and written as attributes into every database:

- SI units; z up, z = 0 at the undisturbed surface, the flat sea bed at z = −h (h may be infinite).
- Right-handed axes; x forward, y to port.  Degrees of freedom: Surge Sway Heave Roll Pitch Yaw.
- Time factor exp(−iωt): a quantity is Re[X exp(−iωt)]; its phase lag is arg X, zero when the crest passes the origin.
- `wave_direction` β is the direction the waves travel to: 0 → +x, π/2 → +y.
- Normals point out of the body into the water.
- A + iB/ω = −ρ ∬ φⱼ nᵢ dS with φⱼ the potential of unit velocity; F = −iρω ∬ (φ_I + φ_D) nᵢ dS.
- Rotations and moments refer to `rotation_center`, by default the origin.
"""

__version__ = "1.0.0"  # version of the distribution; reading it from the metadata takes 0.04 s
DOFS = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
POWER = "damping_lid_power"  # power that lids on the water absorb in waves of 1 m amplitude
ESTIMATE, INTERPOLATED = "error estimate", "interpolated error estimate"  # steps of a frequency, with their time
