"""Which runs are alive on a data folder, and who may write into it."""

from tire_pipeline.runs.on_objects import ObjectTicket, OtherRunsOnObjects, take_back_objects
from tire_pipeline.runs.ticket import LostTicketError, Note, Ticket
from tire_pipeline.runs.turn import take_back, take_turn

__all__ = [
    "LostTicketError",
    "Note",
    "ObjectTicket",
    "OtherRunsOnObjects",
    "Ticket",
    "take_back",
    "take_back_objects",
    "take_turn",
]
