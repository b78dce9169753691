"""Several vertical-sided bodies by the contour method: each depth mode has one plane problem around all plans."""
