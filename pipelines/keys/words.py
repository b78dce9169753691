"""Keys with the same meaning in all files, their names in other programs, and the units in names of keys."""

from __future__ import annotations

COMMON = {
    "angle_deg": "degrees, angle",
    "count": "number of values, both ends included",
    "coefficients": "drag coefficients in place of the tables of a box",
    "density": "kg/m³, density of the water",
    "direction_deg": "direction of travel, 0 → +x, 90 → +y; or give incidence_deg",
    "energy_period": "s, energy period T₋₁₀",
    "from": "first value",
    "gamma": "peak factor γ, for jonswap and tma",
    "gravity": "m/s², acceleration of gravity",
    "incidence_deg": "direction that it comes from, off the bow, 0 from ahead (χ of the SR179 report); or give "
    "direction_deg",
    "mean_period": "s, mean period T₀₁",
    "peak_period": "s, peak period",
    "significant_period": "s, significant period T₁/₃",
    "spectrum": "spectrum of the sea: issc, jonswap, tma, bretschneider …",
    "speed_knots": "speed in knots, in place of speed",
    "spreading": "spreading: cosine:N, half_cosine:S, mitsuyasu:SMAX or wrapped_normal:DEGREES; by default long crests",
    "to": "last value",
    "zero_crossing_period": "s, zero-crossing period T₀₂",
}
# endings in the order of the search, the longest first
ENDINGS = {
    "_kg_per_m": "kg/m",
    "_kN_m2": "kN m²",
    "_N_per_m": "N/m",
    "_t_per_m": "t/m",
    "_kN_per_m3": "kN/m³",
    "_kN_per_m": "kN/m",
    "_tonf_per_m2": "tonf/m²",
    "_kPa_per_m": "kPa/m",
    "_kPa_s_per_m": "kPa s/m",
    "_kNm": "kN m",
    "_kPa": "kPa",
    "_kN": "kN",
    "_tonf": "tonf",
    "_knots": "knots",
    "_hours": "h",
    "_deg": "°",
    "_per_year": "mm/year",
    "_percent": "%",
}
UNITS = (
    *("kN s²/m²", "kN m s²", "kN m s", "kN s/m", "kN/m", "kN", "kPa", "kg/m³", "kg/m", "kg", "rad/s", "m/s²", "m/s"),
    *("m³", "m²", "m", "s", "t", "years", "%", "degrees"),
)
OTHER_NAMES = {  # names of keys in other programs and books
    "height": "h hs hm0 h13 wave_height significant_height significant_wave_height",
    "mean_period": "t tm t01 tm01",
    "zero_crossing_period": "tz t02 tm02",
    "energy_period": "te tm10 tm_10",
    "peak_period": "tp",
    "significant_period": "ts t13 t1/3",
    "direction_deg": "heading heading_deg direction dir towards",
    "headings_deg": "heading heading_deg headings",
    "incidence_deg": "incidence from_deg",
    "swell": "systems system",
    "waves": "sea seas wave",
    "sea": "waves wave",
    "center_of_gravity": "kg cog vcg center_of_mass centre_of_gravity",
    "GM": "gm gmt metacentric_height",
    "breaking_load_kN": "mbl mbs minimum_breaking_load",
    "axial_stiffness_kN": "ea stiffness",
    "pretension_kN": "t0 tension",
}
