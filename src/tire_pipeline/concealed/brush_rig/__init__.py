"""The first simulator: a brush tire on a rig, what the rig is told to do, and what it records."""
