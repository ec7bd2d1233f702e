"""One posterior over sets of effects: each set that is enumerated has a log evidence. Not the default yet."""
