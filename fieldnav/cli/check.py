"""`fieldnav check`: what can be looked at before the robot drives, a line a check."""

import os
import time
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from fieldnav.cli.console import out, print_json
from fieldnav.cli.findings import Finding, Verdict
from fieldnav.errors import SettingsError
from fieldnav.settings.loading import check_fit, load_crop, load_robot
from fieldnav.settings.robot import LARGEST_SIDE_PX

if TYPE_CHECKING:
    from fieldnav.settings.crop import CropProfile
    from fieldnav.settings.robot import Robot

NOT_WELL = 1
"""Exit status when a check failed."""
NOT_CHECKED = ("bus", "wheel modules")


def check(
    robot: Annotated[str, typer.Option(help="Robot; name or path.")],
    crop: Annotated[
        str | None, typer.Option(help="Crop that the robot stands over; name or path. Checks the poses too.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object, for programs.")] = False,
) -> int:
    """Look at what a mission needs before it drives: files, cameras, and where they look. Nothing moves.

    With --crop the robot stands over rows: their spacing tells each camera's tilt, height and yaw.
    """
    found = []
    for finding in _findings(robot, crop):
        found.append(finding)
        if not as_json:
            out().print(finding.line(), soft_wrap=True)
    failed = any(finding.verdict is Verdict.FAIL for finding in found)
    if as_json:
        print_json(
            {
                "ok": not failed,
                "checks": [finding.document() for finding in found],
                "not_checked": list(NOT_CHECKED),
            }
        )
    else:
        print(f"not checked: {', '.join(NOT_CHECKED)}")
    return NOT_WELL if failed else 0


def _findings(robot_name: str, crop_name: str | None) -> Iterator[Finding]:
    """Every check in turn; without a robot file there is nothing more to look at."""
    crop: CropProfile | None = None
    try:
        robot = load_robot(robot_name)
    except SettingsError as error:
        yield Finding("robot file", Verdict.FAIL, str(error))
        return
    yield Finding("robot file", Verdict.OK, robot.name)
    if crop_name is not None:
        try:
            crop = load_crop(crop_name)
        except SettingsError as error:
            yield Finding("crop profile", Verdict.FAIL, str(error))
    if crop is not None:
        rows = f"{crop.rows.per_lane} rows, {crop.rows.spacing_m:g} m apart"
        yield Finding("crop profile", Verdict.OK, f"{crop.name}: {rows}")
        yield _fit(crop, robot)
    yield from _cameras(robot, crop)


def _fit(crop: "CropProfile", robot: "Robot") -> Finding:
    try:
        check_fit(crop, robot)
    except SettingsError as error:
        return Finding("crop fits robot", Verdict.FAIL, str(error))
    return Finding("crop fits robot", Verdict.OK, "its rows run clear of the wheels")


def _cameras(robot: "Robot", crop: "CropProfile | None") -> Iterator[Finding]:
    # OpenCV reads this when it is loaded: a picture's head may claim any size, which is allocated at once.
    os.environ.setdefault("OPENCV_IO_MAX_IMAGE_PIXELS", str(LARGEST_SIDE_PX**2))
    # Here, because other commands need not wait for OpenCV.
    from fieldnav.cli.camera_checks import Watch, compare, look  # noqa: PLC0415
    from fieldnav.cli.pose_checks import pose_findings  # noqa: PLC0415
    from fieldnav.messages import CameraName  # noqa: PLC0415

    frames = {}
    watch = Watch(time.monotonic, time.sleep)
    for name in CameraName:
        settings = robot.cameras.get(name)
        findings, frame = look(name, settings, watch)
        yield from findings
        if frame is not None:
            frames[name] = frame
            if crop is not None:
                yield from pose_findings(frame, crop, settings.pinhole(), robot.camera_limits)
    yield compare({name: robot.cameras.get(name) for name in CameraName}, frames)
