"""The mixed model of all tires and categories: what it is made of, fitted, asked, and taught more."""
