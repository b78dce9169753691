"""What stands in the files of every command: a reference made of the typed tables, and files to begin with."""
