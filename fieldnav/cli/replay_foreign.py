"""`fieldnav replay` of a recording that fieldnav has not made: bag, MCAP, video, folder of pictures."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from fieldnav.cli.console import out, print_json, print_line
from fieldnav.cli.picture_limit import limit_pictures
from fieldnav.errors import SettingsError
from fieldnav.messages import Direction, Side, Twist
from fieldnav.settings.loading import check_fit, load_crop, load_robot
from fieldnav.settings.setting import all_changed

if TYPE_CHECKING:
    from fieldnav.replay.foreign.order import Order
    from fieldnav.settings.crop import CropProfile
    from fieldnav.settings.robot import Robot

USUAL_ROBOT = "bonnbot"
NOT_LOOKED_AT = 1
"""Exit status where much of a recording was not looked at."""


@dataclass(frozen=True, slots=True)
class Foreign:
    """What the options say; None where one is not given."""

    crop: str | None
    robot: str | None
    front: str | None
    rear: str | None
    odometry: str | None
    speed_mps: float | None
    direction: Direction
    rate_hz: float | None
    lanes: int | None
    side: Side
    parent: Path
    changes: Sequence[str] = ()
    again: bool = False
    record: bool = True


def is_foreign(source: str) -> bool:
    """Whether a name stands for something that is there and that is no run's directory."""
    try:
        path = Path(source)
        return source != "" and path.exists() and not (path / "journal.jsonl").exists()
    except (OSError, ValueError):  # too long, or a null byte
        return False


def refuse_for_run(run: str, asked: Foreign) -> None:
    """Raise SettingsError for options that a run of ours has no use for, since it has recorded all that."""
    given = {
        "--robot": asked.robot,
        "--front": asked.front,
        "--rear": asked.rear,
        "--odometry": asked.odometry,
        "--speed": asked.speed_mps,
        "--rate": asked.rate_hz,
        "--lanes": asked.lanes,
        "--again": asked.again or None,
    }
    if named := [option for option, value in given.items() if value is not None]:
        raise SettingsError(
            f"{', '.join(named)}: {run} is a run of fieldnav's; allowed are --crop, --set and --json"
        )


def replay_foreign(source: str, asked: Foreign, as_json: bool) -> int:
    """Replay it and show what the mission did; returns the exit status. Raises SettingsError, OutputError."""
    from fieldnav.cli.frames import quiet_videos  # noqa: PLC0415 - other commands need not wait
    from fieldnav.cli.replay_foreign_report import document, report  # noqa: PLC0415
    from fieldnav.cli.replay_report import watched  # noqa: PLC0415
    from fieldnav.replay.foreign.drive import drive  # noqa: PLC0415

    limit_pictures()  # a picture's head may claim any size, which is allocated at once
    quiet_videos()
    order = _order(source, asked)
    with watched(f"replaying {order.name}") as tell:
        driven = drive(order, tell)
    if as_json:
        print_json(document(order, driven))
    else:
        out().print(report(order, driven))
        print_line(f"run directory: {driven.directory.path}")
    return NOT_LOOKED_AT if driven.left_out else 0


def _order(source: str, asked: Foreign) -> "Order":
    from fieldnav.cli.replay_foreign_opening import opened  # noqa: PLC0415 - as above
    from fieldnav.replay.foreign.odometry import ToldTwist  # noqa: PLC0415
    from fieldnav.replay.foreign.order import Order  # noqa: PLC0415
    from fieldnav.replay.foreign.timeline import Timeline  # noqa: PLC0415
    from fieldnav.replay.foreign.wheels import steadily  # noqa: PLC0415

    crop, robot = _settings(asked)
    found = opened(source, asked, robot)
    told = None if found.odometry is None else ToldTwist(found.odometry)
    speed_mps = crop.speeds.follow_mps if asked.speed_mps is None else asked.speed_mps
    steady = steadily(Twist(vx_mps=asked.direction.sign * speed_mps))
    return Order(
        name=source,
        crop=crop,
        robot=robot,
        cameras=found.cameras,
        timeline=Timeline(source, found.cameras, asked.direction.leading, told),
        moved=told or steady,
        direction=asked.direction,
        lanes=asked.lanes or 1,
        side=asked.side,
        parent=asked.parent,
        again=asked.again,
        record=asked.record,
        seconds=found.seconds,
        notes=found.notes,
        options={
            "lanes": asked.lanes or 1,
            "side": asked.side.value,
            "source": source,
            "front": asked.front,
            "rear": asked.rear,
            "odometry": asked.odometry,
            "speed_mps": None if asked.odometry else speed_mps,
            "direction": asked.direction.value.lower(),
            "rate_hz": asked.rate_hz,
            "again": asked.again,
        },
    )


def _settings(asked: Foreign) -> "tuple[CropProfile, Robot]":
    """Crop and robot as the options have them. Raises SettingsError."""
    if asked.crop is None:
        raise SettingsError("--crop: is not given; a recording of others wants a name or the path of a file")
    loaded = load_crop(asked.crop), load_robot(asked.robot or USUAL_ROBOT)
    crop, robot = all_changed(*loaded, asked.changes)
    check_fit(crop, robot)
    return crop, robot
