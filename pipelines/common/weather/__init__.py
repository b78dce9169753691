"""Weather of a study: seas, wind and current, gusts."""
