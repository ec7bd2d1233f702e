"""The open-world half of the proof: recordings with physics that is in no catalogue."""
