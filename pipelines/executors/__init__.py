"""Who does the work: this process, others of this computer, a dask cluster or jobs of Slurm."""
