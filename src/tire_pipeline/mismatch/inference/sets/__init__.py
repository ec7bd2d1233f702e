"""The sets of effects: screened, fitted, enumerated, and their posterior."""
