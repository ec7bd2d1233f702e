"""Units that are not of SI, by their definitions (NIST Special Publication 811, appendix B)."""

import math

DEGREE = math.pi / 180.0
"""rad."""

POUND = 0.45359237
"""kg."""

GRAVITY = 9.80665
"""The standard value, m/s^2. `scipy.constants` has it too, but takes a tenth of a second to import."""

FOOT = 0.3048
INCH = 0.0254
MILE = 1609.344
"""m."""

POUND_FORCE = POUND * GRAVITY
"""N."""

PSI = POUND_FORCE / INCH**2
"""Pa."""
