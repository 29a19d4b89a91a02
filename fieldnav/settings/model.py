"""What every settings model shares: unknown keys are refused and nothing changes after loading."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

LONGEST_NAME = 64
"""Characters of a name: with a time and an ending it stays a quarter of what file systems take."""

FileName = Annotated[
    str,
    Field(
        pattern=r"^[a-z][a-z0-9-]*$",
        max_length=LONGEST_NAME,
        description=f"lower-case letters, digits and hyphens, at most {LONGEST_NAME}",
    ),
]
"""What a profile is called: fit for a file name and a folder name everywhere."""


class Settings(BaseModel):
    """A frozen model that refuses keys it does not know and numbers that are not finite."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
