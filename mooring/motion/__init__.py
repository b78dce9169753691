"""Bodies in time: a floating body on its lines under waves, wind and current, by one equation of motion."""
