"""Seas beyond one wind sea in deep water: in shallow water, of several systems, from files; and limits by breaking.

`breaking` limits wave heights, `shallow` has the TMA spectrum, `two_peaks` the spectrum of Ochi and Hubble. `systems`
combines seas, `spectra_files` reads spectra of buoys and hindcasts, `families` names all spectra, `record_faults`
checks measured records.  A spectrum is a `mooring.environment.spectrum.Spectrum`.
"""
