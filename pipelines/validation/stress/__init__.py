"""Random scenes over everything a user may ask for, each solved as the commands do and tested against laws."""
