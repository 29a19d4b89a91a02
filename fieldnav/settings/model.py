"""What every settings model shares: unknown keys are refused and nothing changes after loading."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

FileName = Annotated[
    str, Field(pattern=r"^[a-z][a-z0-9-]*$", description="lower-case letters, digits and hyphens")
]
"""What a profile is called: fit for a file name and a folder name everywhere."""


class Settings(BaseModel):
    """A frozen model that refuses keys it does not know and numbers that are not finite."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
