"""What a recording says about a set of effects: priors, products of columns, likelihood, log evidence."""
