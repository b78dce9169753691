"""Weather of a study: seas, wind and current, gusts."""

SPREADINGS = "cosine:N, half_cosine:S, mitsuyasu:SMAX, wrapped_normal:DEGREES"  # in words of flags and studies
