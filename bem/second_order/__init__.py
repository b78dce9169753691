"""Forces of second order in the wave amplitude, at difference and sum frequencies."""
