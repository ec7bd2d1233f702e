"""True tires on the manufacturers' rigs: their forces, how each measures them, and the raw sweeps."""
