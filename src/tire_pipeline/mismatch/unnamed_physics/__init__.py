"""Unnamed physics: the drivers of the unexplained residual, a short equation for it, and its proof."""
