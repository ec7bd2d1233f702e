"""Recordings of driven vehicles: from the motion of the body to the forces of an axle."""
