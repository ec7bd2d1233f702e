"""Twelve sealed mechanisms, not to be tuned on: six with a closed form of at most 12 nodes, six without."""

from tire_pipeline.concealed.open_world.mechanism import Mechanism
from tire_pipeline.concealed.open_world.sealed import beyond, in_grammar

MECHANISMS: tuple[Mechanism, ...] = (*in_grammar.MECHANISMS, *beyond.MECHANISMS)
