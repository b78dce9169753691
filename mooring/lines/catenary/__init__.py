"""One uniform line: closed forms, forces and stiffness."""
