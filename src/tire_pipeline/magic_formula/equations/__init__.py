"""The equations, written once for arrays and for the compiler."""
