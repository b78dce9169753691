"""The waves around bodies, from the far field of the bodies."""
