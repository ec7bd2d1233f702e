"""The thesis' translator: a classifier as reward, an agent that moves features bin by bin."""
