"""`fieldnav check`: everything that can be looked at before the robot drives, a line a check."""

import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fieldnav.cli.console import FAILED, print_json
from fieldnav.cli.findings import document, print_finding
from fieldnav.cli.output_folder import output_path
from fieldnav.cli.picture_limit import limit_pictures
from fieldnav.errors import SettingsError
from fieldnav.preflight.finding import Finding, Verdict
from fieldnav.settings.loading import check_fit, load_crop, load_robot

if TYPE_CHECKING:
    from fieldnav.settings.crop import CropProfile
    from fieldnav.settings.robot import Robot

NOT_WELL = 1
"""Exit status when a check failed, but none of the files."""
ROBOT_FILE, CROP_PROFILE = "robot file", "crop profile"
"""The checks of what was named on the command line; when one of them fails, the input is wrong."""


def check(
    robot: Annotated[str, typer.Option(help="Robot; name or path.")],
    crop: Annotated[
        str | None,
        typer.Option(help="Crop that the robot stands over; name or path. Checks poses and rows too."),
    ] = None,
    out_dir: Annotated[
        Path,
        typer.Option(
            "--out", parser=output_path, help="Folder that run directories will be made in.", metavar="DIR"
        ),
    ] = Path("runs"),
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object, for programs.")] = False,
) -> int:
    """Look at all that a mission needs before it drives: computer, bus, modules, battery, cameras, rows.

    Nothing moves: the modules are brought up and told to stand still; where another host is heard, nothing
    is sent at all. With --crop the robot stands over rows: they tell where each camera looks, and whether
    the profile is of what grows here.

    Exit status: 0 when no check failed, 1 when one did, 2 when the robot file or the crop profile is wrong.
    """
    found = []
    for finding in _findings(robot, crop, out_dir):
        found.append(finding)
        if not as_json:
            print_finding(finding)
    failed = {finding.check for finding in found if finding.verdict is Verdict.FAIL}
    if as_json:
        print_json({"ok": not failed, "checks": [document(finding) for finding in found]})
    if failed & {ROBOT_FILE, CROP_PROFILE}:
        return FAILED
    return NOT_WELL if failed else 0


def _findings(robot_name: str, crop_name: str | None, runs: Path) -> Iterator[Finding]:
    """Every check in turn; without a robot file there is nothing more to look at."""
    from drivers.wire_layout import check_nodes  # noqa: PLC0415 - other commands need not wait for it

    try:
        robot = load_robot(robot_name)
        check_nodes(robot)
    except SettingsError as error:
        yield Finding(ROBOT_FILE, Verdict.FAIL, str(error))
        return
    yield Finding(ROBOT_FILE, Verdict.OK, robot.name)
    crop: CropProfile | None = None
    if crop_name is not None:
        try:
            crop = load_crop(crop_name)
        except SettingsError as error:
            yield Finding(CROP_PROFILE, Verdict.FAIL, str(error))
    if crop is not None:
        rows = f"{crop.rows.per_lane} rows, {crop.rows.spacing_m:g} m apart"
        yield Finding(CROP_PROFILE, Verdict.OK, f"{crop.name}: {rows}")
        yield _fit(crop, robot)
    yield from _on_the_robot(robot, crop, runs)


def _fit(crop: "CropProfile", robot: "Robot") -> Finding:
    try:
        check_fit(crop, robot)
    except SettingsError as error:
        return Finding("crop fits robot", Verdict.FAIL, str(error))
    return Finding("crop fits robot", Verdict.OK, "its rows run clear of the wheels")


def _on_the_robot(robot: "Robot", crop: "CropProfile | None", runs: Path) -> Iterator[Finding]:
    """Everything that needs the machine itself."""
    limit_pictures()  # a picture's head may claim any size, which is allocated at once
    # Here, because other commands need not wait for OpenCV.
    from fieldnav.cli.frames import quiet_videos  # noqa: PLC0415
    from fieldnav.preflight.computer import read_computer  # noqa: PLC0415
    from fieldnav.preflight.gear import opened  # noqa: PLC0415
    from fieldnav.preflight.preflight import preflight  # noqa: PLC0415
    from fieldnav.preflight.waiting import Watch  # noqa: PLC0415

    quiet_videos()
    watch = Watch(time.monotonic, time.sleep)
    with opened(robot, watch.clock) as (gear, findings):
        yield from findings
        yield from preflight(robot, crop, gear, read_computer(runs), watch)
