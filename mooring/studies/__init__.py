"""Studies of a moored body, one each: what is asked of lines, loads and a wave database together."""
