"""Scripts that run in the interpreter of another program and know nothing of this one."""
