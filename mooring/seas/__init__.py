"""Seas beyond one wind sea in deep water: seas in shallow water, of several systems, or from files; and limits due
to breaking.

`breaking` limits wave heights, `shallow` has the TMA spectrum, `two_peaks` the spectrum of Ochi and Hubble. `systems`
combines seas, `spectra_files` reads spectra of buoys and hindcasts, `families` names all spectra, `record_faults`
checks measured records.  A spectrum is a `mooring.environment.spectrum.Spectrum`.
"""
