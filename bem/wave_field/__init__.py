"""The waves around bodies, from their far field."""
