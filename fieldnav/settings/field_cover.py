"""Part of the field file: what grows there that nobody sowed, weeds among the rows and grass about them."""

from typing import Annotated

from pydantic import AfterValidator, Field

from fieldnav.settings.field_rows import ascending
from fieldnav.settings.model import Settings

WeedSize = Annotated[float, Field(ge=0.005, le=0.5)]


class Weeds(Settings):
    """Plants that are not the crop."""

    per_m2: float = Field(default=2.0, ge=0, le=60)
    size_m: Annotated[tuple[WeedSize, WeedSize], AfterValidator(ascending)] = (0.02, 0.08)
    large: float = Field(default=0.03, ge=0, le=1, description="share of the weeds as large as the crop")
    lines: float = Field(
        default=0.1,
        ge=0,
        le=1,
        description="share of the weeds in lines that are not rows: in tracks, between rows, askew",
    )
    patches: float = Field(default=0.3, ge=0, le=1, description="share of the others that grow in patches")
    headland_per_m2: float = Field(default=0.3, ge=0, le=20)


class GrassEdge(Settings):
    """A meadow about the field."""

    present: bool = False
    beyond_ends_m: float = Field(
        default=3.0, ge=0, le=5, description="from the row ends by plan to the grass"
    )
    beside_m: float = Field(default=1.0, ge=0, le=5, description="from the outermost rows to the grass")
    depth_m: float = Field(default=2.5, ge=0.5, le=10, description="of grass, as far as it is grown")
    tufts_per_m2: float = Field(default=160.0, ge=1, le=400)
