"""The robot file that a client of the served robot drives by."""

from pathlib import Path

from fieldnav.journal.files import write_atomically
from fieldnav.messages import CameraName
from fieldnav.settings.documents import written
from fieldnav.settings.robot import Bus, Robot

SOCKETCAND = "socketcand"
HEADER = "# A simulated robot that `fieldnav simulate --serve` offers; good for as long as that runs.\n"


def reached_at(
    robot: Robot, channel: str, can_address: tuple[str, int], sources: dict[CameraName, str], latency_s: float
) -> Robot:
    """The same machine, reached at these addresses, its frames `latency_s` old when they come."""
    host, port = can_address
    bus = Bus(
        interface=SOCKETCAND,
        channel=channel,
        bitrate=robot.can.bitrate,
        options={"host": host, "port": port},
    )
    cameras = {
        name.value: robot.cameras.get(name).model_copy(
            update={"source": sources[name], "latency_s": latency_s}
        )
        for name in CameraName
    }
    return robot.model_copy(update={"can": bus, "cameras": robot.cameras.model_copy(update=cameras)})


def write_robot_file(path: Path, robot: Robot) -> None:
    """Write the whole file or nothing, for its owner alone to read. Raises OutputError."""
    text = HEADER + written(robot.model_dump(mode="json"))
    # For its owner alone: it says where the bus is, and whoever reaches that drives the robot.
    write_atomically(path, text.encode())
