"""The waves around bodies, from what their far field is."""
