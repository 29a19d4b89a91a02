"""`fieldnav simulate --serve`: the simulated robot for another process to drive, until it is stopped."""

import shlex
import sys
from collections.abc import Mapping
from math import degrees
from pathlib import Path

from fieldnav.cli.console import json_of, out, print_line, table
from fieldnav.errors import SettingsError
from fieldnav.inquiry.figure_words import against_truth
from fieldnav.journal.files import check_replaceable
from fieldnav.messages import CameraName, Side
from fieldnav.mission.interruption import Interruption
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.kinds import is_path
from fieldnav.settings.loading import load_crop, load_robot
from fieldnav.simulation.served.robot_file import write_robot_file
from fieldnav.simulation.served.served_robot import Offer, ServedRobot
from fieldnav.simulation.served.witness import Account


def refuse(options: Mapping[str, bool]) -> None:
    """Raises SettingsError for an option that was given and has nothing to act on."""
    for option, given in options.items():
        if given:
            raise SettingsError(f"{option}: does not go with --serve, which drives nothing")


def serve_robot(
    field: FieldSettings, robot: str, side: Side, port: int, sketch: bool, robot_file: Path, as_json: bool
) -> int:
    """Serve until a signal such as Ctrl-C, then tell what the robot truly did; returns the exit status.

    Raises FieldnavError for settings that do not fit, for ports that are taken, for an unwritable file.
    """
    if not is_path(str(robot_file)):
        raise SettingsError(
            f"--robot-file: {robot_file} is not allowed; allowed is a file that ends in .yaml"
        )
    check_replaceable(robot_file)
    offer = Offer(field, load_crop(field.crop), load_robot(robot), side, port, sketch)
    with ServedRobot(offer) as served:
        write_robot_file(robot_file, served.robot)
        with Interruption() as interruption:  # the world is between two steps when it ends
            print_line(_offered(served, robot_file) if as_json else _invitation(offer, robot_file))
            sys.stdout.flush()
            served.serve(lambda: interruption.asked)
        account = served.account()
    if as_json:
        print(json_of(_as_document(account)))
    else:
        out().print(table("", ("", ""), _as_rows(account)))
    return 0


def _invitation(offer: Offer, robot_file: Path) -> str:
    path = f"./{robot_file}" if robot_file.parent == Path() else str(robot_file)
    task = ["--crop", offer.field.crop, "--lanes", str(offer.field.lanes), "--side", offer.side.value]
    command = shlex.join(["fieldnav", "run", "--robot", path, *task])
    return f"serving {offer.robot.name} in field {offer.field.name}: drive it with: {command}"


def _offered(served: ServedRobot, robot_file: Path) -> str:
    """Where everything is, as one line of JSON."""
    cameras = {name.value: served.robot.cameras.get(name).source for name in CameraName}
    bus = served.robot.can.model_dump(mode="json")
    return json_of({"can": bus, "cameras": cameras, "robot_file": str(robot_file)})


def _as_document(account: Account) -> dict[str, object]:
    pose = account.pose
    return {
        "truth": account.truth.model_dump(mode="json"),
        "distance_m": round(account.distance_m, 3),
        "pose": {
            "x_m": round(pose.x_m, 3),
            "y_m": round(pose.y_m, 3),
            "heading_deg": round(degrees(pose.heading_rad), 3),
        },
    }


def _as_rows(account: Account) -> list[tuple[str, str]]:
    pose = account.pose
    return [
        ("distance, truly", f"{account.distance_m:.1f} m"),
        ("stands at", f"x {pose.x_m:.2f} m, y {pose.y_m:.2f} m, {degrees(pose.heading_rad):.1f} deg"),
        *against_truth(account.truth),
    ]
