"""The evidence of a set of effects: priors, products of columns, likelihood, log evidence."""
