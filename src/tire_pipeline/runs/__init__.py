"""Which runs are alive on a data folder, and who may write into it."""

from tire_pipeline.runs.ticket import LostTicketError, Note, Ticket
from tire_pipeline.runs.turn import take_back, take_turn

__all__ = ["LostTicketError", "Note", "Ticket", "take_back", "take_turn"]
