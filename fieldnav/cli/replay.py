"""`fieldnav replay`: a recorded run through today's code."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fieldnav.cli.console import out, print_json
from fieldnav.errors import SettingsError
from fieldnav.settings.loading import load_crop
from fieldnav.settings.setting import changed

if TYPE_CHECKING:
    from fieldnav.journal.resolved import Settings

DIFFERENT = 1
"""Exit status when anything came out otherwise."""


def replay(
    run: Annotated[
        str, typer.Argument(help="A run's name, its path, or 'last'; of a part of a name, the newest run.")
    ] = "last",
    crop: Annotated[str | None, typer.Option(help="Another crop profile; name or path.")] = None,
    changes: Annotated[
        list[str] | None,
        typer.Option(
            "--set", help="Another value, say switching.headland_m=0.6; may be repeated.", metavar="KEY=VALUE"
        ),
    ] = None,
    runs: Annotated[Path, typer.Option("--runs", help="The folder that holds the runs.")] = Path("runs"),
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON and nothing else.")] = False,
) -> int:
    """Put a recorded run through today's perception, states and CAN encoding, and list what differs.

    An unchanged program with unchanged settings repeats the run bit for bit. --crop and --set ask what would
    have been. The robot of the recording then still drives as it drove: see docs/replay.md.

    Exit status: 0 when nothing differs, 1 when anything does, 2 when the input is wrong.
    """
    from fieldnav.cli.replay_report import report, watched  # noqa: PLC0415 - others need not wait
    from fieldnav.journal.directory import find_run  # noqa: PLC0415
    from fieldnav.journal.resolved import read_settings  # noqa: PLC0415
    from fieldnav.replay.replay import replay as again  # noqa: PLC0415

    directory = find_run(run, runs)
    then = read_settings(directory.settings)
    now = _asked(then, crop, changes or [])
    with watched(f"replaying {directory.path.name}") as tell:
        done = again(directory, then, now, tell)
    if as_json:
        print_json(done.model_dump(mode="json"))
    else:
        out().print(report(done))
    return 0 if done.same else DIFFERENT


def _asked(then: "Settings", crop: str | None, changes: list[str]) -> "Settings":
    """The settings of the run as the options change them. Raises SettingsError."""
    from fieldnav.journal.resolved import Settings  # noqa: PLC0415 - see replay

    profile, robot = load_crop(crop) if crop else then.crop, then.robot
    for change in changes:
        key, equals, value = change.partition("=")
        if not equals:
            raise SettingsError(
                f"--set {change}: has no '='; allowed is KEY=VALUE, say speeds.follow_mps=0.4"
            )
        if key.startswith("robot."):
            robot = changed(robot, key.removeprefix("robot."), value)
        else:
            profile = changed(profile, key.removeprefix("crop."), value)
    return Settings(profile, robot, then.options)
