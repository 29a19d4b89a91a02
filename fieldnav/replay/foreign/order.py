"""What decides a replay of a foreign recording."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from pathlib import Path

from fieldnav.journal.resolved import Option
from fieldnav.messages import CameraName, Direction, Side
from fieldnav.replay.foreign.camera import ForeignCamera
from fieldnav.replay.foreign.timeline import Timeline
from fieldnav.replay.foreign.wheels import Moved
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.robot import Robot

EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
NS_PER_US = 1000


@dataclass(frozen=True, slots=True)
class Order:
    """A recording that has been opened, and how it is to be looked at.

    again: begin anew after each stop. notes: what a person should know of what is not looked at. options: as
    they are kept in settings.yaml.
    """

    name: str
    crop: CropProfile
    robot: Robot
    cameras: Mapping[CameraName, ForeignCamera]
    timeline: Timeline
    moved: Moved
    direction: Direction
    lanes: int
    side: Side
    parent: Path
    again: bool = False
    record: bool = True
    seconds: float = 0.0
    notes: tuple[str, ...] = ()
    options: Mapping[str, Option] = field(default_factory=dict)

    @property
    def begun_utc(self) -> datetime:
        """When the recording began, by its own clock; to be asked before it goes on."""
        return EPOCH + timedelta(microseconds=self.timeline.begun_ns // NS_PER_US)
