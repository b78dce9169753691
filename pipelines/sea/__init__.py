"""`hakobune sea`: spectra and records of waves."""
