"""What is computed here beside what is known: the SR179 report (1982) made again, other programs, laws of waves.

Nothing but the command line imports this room.
"""
