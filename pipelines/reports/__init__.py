"""What the SR179 report (1982) printed, made again: comparisons and tables of sections."""
