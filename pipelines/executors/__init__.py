"""Executors: this process, other processes of this computer, a dask cluster or jobs of Slurm."""
