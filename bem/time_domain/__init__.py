"""From frequency to time: retardation functions and state-space models of them."""
