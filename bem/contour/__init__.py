"""The contour method: vertical-sided bodies by domain decomposition, no panels."""
