"""`fieldnav replay`: a recorded run through today's code, and what others have recorded."""

from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.console import out, print_json
from fieldnav.cli.log.options import RunArgument, RunsOption
from fieldnav.cli.replay_foreign import Foreign, is_foreign, refuse_for_run, replay_foreign
from fieldnav.cli.replay_foreign_options import (
    AgainOption,
    DirectionChoice,
    DirectionOption,
    FrontOption,
    LanesOption,
    OdometryOption,
    OutOption,
    RateOption,
    RearOption,
    RobotOption,
    SpeedOption,
)
from fieldnav.cli.simulate import SideOption
from fieldnav.errors import SettingsError
from fieldnav.messages import Direction, Side
from fieldnav.settings.loading import load_crop
from fieldnav.settings.setting import all_changed

DIFFERENT = 1
"""Exit status when anything came out otherwise."""


def replay(
    run: RunArgument = "last",
    crop: Annotated[str | None, typer.Option(help="Another crop profile; name or path.")] = None,
    changes: Annotated[
        list[str] | None,
        typer.Option(
            "--set", help="Another value, say switching.headland_m=0.6; may be repeated.", metavar="KEY=VALUE"
        ),
    ] = None,
    runs: RunsOption = Path("runs"),
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON and nothing else.")] = False,
    robot: RobotOption = None,
    front: FrontOption = None,
    rear: RearOption = None,
    odometry: OdometryOption = None,
    speed: SpeedOption = None,
    direction: DirectionChoice = DirectionOption.FORWARD,
    rate: RateOption = None,
    lanes: LanesOption = None,
    side: Annotated[
        SideOption, typer.Option(help="Where the next lanes lie in a foreign recording, seen forward.")
    ] = SideOption.RIGHT,
    again: AgainOption = False,
    out_dir: OutOption = None,
) -> int:
    """Put a recorded run through today's perception, states and CAN encoding, and list what differs.

    An unchanged program with unchanged settings repeats the run bit for bit. --crop and --set ask what would
    have been; the robot of the recording then still drives as it drove.

    RUN may also be what others have recorded: a ROS 1 or ROS 2 bag, an MCAP file, a video, a folder of
    pictures. The mission then drives by its pictures, with wheels of which only the speed is assumed, and
    leaves a run's directory. docs/replay.md tells what that shows.

    Exit status: 0 when nothing differs or a foreign recording was replayed, 1 when anything differs or much
    of a foreign recording was not looked at, 2 when the input is wrong or damaged.
    """
    facing, parent = Direction[direction.name], out_dir or runs
    asked = Foreign(
        crop, robot, front, rear, odometry, speed, facing, rate, lanes, Side(side.value), parent,
        changes or [], again,
    )  # fmt: skip
    if is_foreign(run):
        return replay_foreign(run, asked, as_json)
    refuse_for_run(run, asked)
    return _again(run, runs, crop, changes or [], as_json)


def _again(run: str, runs: Path, crop: str | None, changes: list[str], as_json: bool) -> int:
    """Replay a run of ours; returns the exit status. Raises FieldnavError."""
    from fieldnav.cli.replay_report import report, watched  # noqa: PLC0415 - others need not wait
    from fieldnav.journal.directory import find_run  # noqa: PLC0415
    from fieldnav.journal.resolved import Settings, read_settings  # noqa: PLC0415
    from fieldnav.replay.replay import replay as replayed  # noqa: PLC0415

    directory = find_run(run, runs)
    then = read_settings(directory.settings)
    if source := then.options.get("source"):
        raise SettingsError(f"{directory.path}: is a replay itself; allowed is what it was made of: {source}")
    profile = load_crop(crop) if crop else then.crop
    now = Settings(*all_changed(profile, then.robot, changes), then.options)
    with watched(f"replaying {directory.path.name}") as tell:
        done = replayed(directory, then, now, tell)
    if as_json:
        print_json(done.model_dump(mode="json"))
    else:
        out().print(report(done))
    return 0 if done.same else DIFFERENT
