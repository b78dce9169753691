"""The keys of the files of every command: a reference from the typed tables, and files to begin with."""
