"""The contour method: vertical-sided bodies solved by domain decomposition, without panels."""
