"""Translators: from what one category measured to what the target category would have measured."""

from tire_pipeline.translation.base import (
    TRANSLATORS,
    Translator,
    make_translator,
    translator_from_state,
)

__all__ = ["TRANSLATORS", "Translator", "make_translator", "translator_from_state"]
