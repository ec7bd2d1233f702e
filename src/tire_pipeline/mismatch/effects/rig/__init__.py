"""Effects in the rig, its road and how the tire sits in it."""
