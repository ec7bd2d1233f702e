"""Translators: from what one category measured to what the target category would have measured."""

from tire_pipeline.translation.base import Translator, make_translator, translator_from_state
from tire_pipeline.translation.result import TranslationResult

__all__ = ["TranslationResult", "Translator", "make_translator", "translator_from_state"]
