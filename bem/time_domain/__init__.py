"""From frequency to time: damping at every frequency, and the memory of the water as a linear system with states."""
