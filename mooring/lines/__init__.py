"""Mooring lines in detail: statics of lines with many parts, and the dynamics of lines."""
