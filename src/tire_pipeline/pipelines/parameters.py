"""What all parameter models share: unknown keys are errors, and values are not changed afterwards."""

from pydantic import BaseModel, ConfigDict


class Parameters(BaseModel):
    """Base of the parameter models; a misspelt key is named, never ignored."""

    model_config = ConfigDict(extra="forbid", frozen=True)
