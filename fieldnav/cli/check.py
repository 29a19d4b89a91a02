"""`fieldnav check`: what can be looked at before the robot drives, a line a check."""

import time
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from fieldnav.cli.console import FAILED, out, print_json
from fieldnav.cli.findings import Finding, Verdict
from fieldnav.cli.picture_limit import limit_pictures
from fieldnav.errors import SettingsError
from fieldnav.settings.loading import check_fit, load_crop, load_robot

if TYPE_CHECKING:
    from fieldnav.settings.crop import CropProfile
    from fieldnav.settings.robot import Robot

NOT_WELL = 1
"""Exit status when a check failed, but none of the files."""
ROBOT_FILE, CROP_PROFILE = "robot file", "crop profile"
"""The checks of what was named on the command line; when one of them fails, the input is wrong."""
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

    Exit status: 0 when no check failed, 1 when one did, 2 when the robot file or the crop profile is wrong.
    """
    found = []
    for finding in _findings(robot, crop):
        found.append(finding)
        if not as_json:
            out().print(finding.line(), soft_wrap=True)
    failed = {finding.check for finding in found if finding.verdict is Verdict.FAIL}
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
    if failed & {ROBOT_FILE, CROP_PROFILE}:
        return FAILED
    return NOT_WELL if failed else 0


def _findings(robot_name: str, crop_name: str | None) -> Iterator[Finding]:
    """Every check in turn; without a robot file there is nothing more to look at."""
    crop: CropProfile | None = None
    try:
        robot = load_robot(robot_name)
    except SettingsError as error:
        yield Finding(ROBOT_FILE, Verdict.FAIL, str(error))
        return
    yield Finding(ROBOT_FILE, Verdict.OK, robot.name)
    if crop_name is not None:
        try:
            crop = load_crop(crop_name)
        except SettingsError as error:
            yield Finding(CROP_PROFILE, Verdict.FAIL, str(error))
    if crop is not None:
        rows = f"{crop.rows.per_lane} rows, {crop.rows.spacing_m:g} m apart"
        yield Finding(CROP_PROFILE, Verdict.OK, f"{crop.name}: {rows}")
        yield _fit(crop, robot)
    yield from _cameras(robot, crop)


def _fit(crop: "CropProfile", robot: "Robot") -> Finding:
    try:
        check_fit(crop, robot)
    except SettingsError as error:
        return Finding("crop fits robot", Verdict.FAIL, str(error))
    return Finding("crop fits robot", Verdict.OK, "its rows run clear of the wheels")


def _cameras(robot: "Robot", crop: "CropProfile | None") -> Iterator[Finding]:
    limit_pictures()  # a picture's head may claim any size, which is allocated at once
    # Here, because other commands need not wait for OpenCV.
    from fieldnav.cli.camera_checks import Watch, compare, look  # noqa: PLC0415
    from fieldnav.cli.frames import quiet_videos  # noqa: PLC0415
    from fieldnav.cli.pose_checks import pose_findings  # noqa: PLC0415
    from fieldnav.messages import CameraName  # noqa: PLC0415

    quiet_videos()
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
