"""The spectrum of a sea as CSV, and the recognition of files that `hakobune sea` wrote."""

from hakobune.meshing.seals import write_sealed

from ..common.outputs import opening
from .result import curve


def write_spectrum(path, found):
    """Write the spectrum, with its 95 % confidence band for an estimate, as CSV that --table reads."""
    spectrum = found.spectrum
    comment = f"# {found.title}; 4 sqrt(m0) {spectrum.significant_height:.6g} m, Tp {spectrum.Tp:.6g} s\n"
    names, columns = "omega_rad_s,density_m2_s_rad", list(curve(spectrum))
    if found.analysed:
        comment += f"# 95 % confidence band, {found.estimate.degrees_of_freedom:.4g} degrees of freedom\n"
        names += ",low_m2_s_rad,high_m2_s_rad"
        columns += found.estimate.confidence(0.95)
    rows = [",".join(f"{value:.8g}" for value in row) for row in zip(*columns, strict=True)]
    write_sealed(path, comment + "\n".join([names, *rows]) + "\n")


def is_spectrum(path):
    """Whether a file was made by `write_spectrum`, unlike the user's own table for --table"""
    first, names = opening(path)
    return "; 4 sqrt(m0) " in first and names.startswith("omega_rad_s,density_m2_s_rad")


def is_record(path):
    """Whether a file is a record generated from a spectrum, not a measured one"""
    first, names = opening(path)
    return " spectrum, 4 sqrt(m0) " in first and names == "time_s,elevation_m"
