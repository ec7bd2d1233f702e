"""The sets of effects: screened, fitted, enumerated, and what their posterior says."""
