"""Scripts for the interpreter of another program, independent of this one."""
