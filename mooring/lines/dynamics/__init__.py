"""One line in motion: lumped masses and implicit steps."""
