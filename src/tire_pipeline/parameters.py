"""What all parameter models share: unknown keys are errors, and values are not changed afterwards."""

from difflib import get_close_matches
from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict, model_validator


def _several(value: object) -> object:
    if isinstance(value, str):
        return [each.strip() for each in value.split(";") if each.strip()]
    return value


Several = Annotated[list[str], BeforeValidator(_several)]
"""Names; on the command line one text, with semicolons between them."""


class Parameters(BaseModel):
    """Base of the parameter models; a misspelt key is named, never ignored."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    @model_validator(mode="before")
    @classmethod
    def _known_names(cls, values: object) -> object:
        """Name the nearest parameter to one that is unknown."""
        for name in values if isinstance(values, dict) else ():
            if name not in cls.model_fields:
                near = get_close_matches(str(name), list(cls.model_fields), n=1, cutoff=0.5)
                known = ", ".join(cls.model_fields)
                advice = f"did you mean {near[0]!r}?" if near else f"there are {known}"
                raise ValueError(f"there is no parameter {name!r}: {advice}")
        return values
