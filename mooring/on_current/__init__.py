"""Waves on a current: the frequency at which a body at rest meets them, and a body of a database in such waves."""
