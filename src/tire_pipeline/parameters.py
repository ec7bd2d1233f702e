"""What all parameter models share: unknown keys are errors, and values are not changed afterwards."""

from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict, model_validator

from tire_pipeline.errors import did_you_mean


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
                known = ", ".join(cls.model_fields)
                advice = did_you_mean(str(name), cls.model_fields, f"there are {known}", cutoff=0.5)
                raise ValueError(f"there is no parameter {name!r}: {advice}")
        return values
