"""What several commands share: flags, typed tables, units, output files, progress, Ctrl-C."""
