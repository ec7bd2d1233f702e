"""The model of a retraining: trained, compared on held-out tires, released or taken back."""
