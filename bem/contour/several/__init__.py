"""Several vertical-sided bodies: one plane problem around all plans for each depth mode."""
