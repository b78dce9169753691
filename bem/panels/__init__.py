"""The panel method: direct boundary elements with the finite-depth Green function."""
