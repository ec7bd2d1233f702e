"""The second simulator: a rig and a tire that share no equation with the first or with the engine.

Bristles with LuGre friction on a modal carcass, rubber friction by a master curve, an energy balance, a flat
belt with servos. `draw_case` makes recordings with a known cause. Its sources stand in the modules.
"""

from tire_pipeline.concealed.second.case import NOTHING, SecondCase, Truth, draw_case
from tire_pipeline.concealed.second.causes import CAUSES
from tire_pipeline.concealed.second.content import content_hash

__all__ = ["CAUSES", "NOTHING", "SecondCase", "Truth", "content_hash", "draw_case"]
