"""The equations in compiled form, over tires and points."""
