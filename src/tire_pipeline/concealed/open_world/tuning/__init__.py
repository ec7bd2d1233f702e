"""Twelve mechanisms to tune an open-world search on: six with a closed form, six with a memory."""

from tire_pipeline.concealed.open_world.mechanism import Mechanism
from tire_pipeline.concealed.open_world.tuning import beyond, in_grammar

MECHANISMS: tuple[Mechanism, ...] = (*in_grammar.MECHANISMS, *beyond.MECHANISMS)
