"""The waves around bodies, computed from the far field of the bodies."""
