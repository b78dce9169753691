"""Waves on a current: at which frequency a body at rest meets them, and a body of a database among them."""
