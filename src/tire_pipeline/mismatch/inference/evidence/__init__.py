"""What a recording says of a set of effects: priors, products of columns, likelihood, log evidence."""
