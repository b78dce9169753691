"""Seas beyond one wind sea in deep water: in shallow water, of several systems, from files; and what water can hold.

`breaking` says how high waves can be, `shallow` has the TMA spectrum, `two_peaks` that of Ochi and Hubble, `systems`
puts seas together, `spectra_files` reads what buoys and hindcasts give, `families` names all spectra, `record_faults`
looks at measured records.  A spectrum is a `mooring.environment.spectrum.Spectrum`.
"""
