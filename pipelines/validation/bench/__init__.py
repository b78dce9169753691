"""Error against time of this program's solvers and of others, on bodies with a reference solution."""
