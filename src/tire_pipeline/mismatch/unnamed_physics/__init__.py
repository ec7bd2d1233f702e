"""Unnamed physics: what drives the unexplained part, a short equation of it, and its proof."""
