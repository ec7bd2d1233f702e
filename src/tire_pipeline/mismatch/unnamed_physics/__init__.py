"""Physics without a name: what drives the unexplained part, a short equation of it, and its proof."""
