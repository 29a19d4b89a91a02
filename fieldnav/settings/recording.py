"""What a run records, and how much of the disk it may take."""

from pydantic import Field

from fieldnav.settings.model import Settings


class RecordingSettings(Settings):
    """Of the recording of one run."""

    quality: int = Field(default=90, ge=50, le=100, description="of the pictures' JPEG")
    piece_mb: int = Field(default=1024, ge=1, le=65536, description="past it a new file is begun")
    budget_gb: float = Field(
        default=50, gt=0, le=10000, description="of one run; its oldest files then give way to the newest"
    )
    keep_free_gb: float = Field(default=2, ge=0, le=1000, description="of the disk; recording ends before")
    queue_mb: int = Field(
        default=128,
        ge=8,
        le=4096,
        description="of memory; past it pictures are left out",
    )
