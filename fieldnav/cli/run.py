"""`fieldnav run`: the field mission on a robot."""

import json
import time
from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fieldnav.cli.console import out, print_error, print_json, print_line
from fieldnav.cli.findings import print_finding
from fieldnav.cli.output_folder import output_path
from fieldnav.cli.simulate import STOPPED, SideOption
from fieldnav.errors import SettingsError
from fieldnav.messages import Side
from fieldnav.settings.loading import check_fit, load_crop, load_robot

if TYPE_CHECKING:
    from fieldnav.journal.directory import RunDirectory
    from fieldnav.journal.summary import Summary
    from fieldnav.mission.real import Order
    from fieldnav.mission.taking_up import BrokenOff
    from fieldnav.preflight.finding import Finding

MOST_LANES = 1000


def run(
    robot: Annotated[str | None, typer.Option(help="Robot; name or path.")] = None,
    crop: Annotated[str | None, typer.Option(help="Crop; name or path.")] = None,
    lanes: Annotated[
        int | None, typer.Option(min=1, max=MOST_LANES, help="Lanes to drive; 1 where none are given.")
    ] = None,
    side: Annotated[
        SideOption | None, typer.Option(help="Where the next lanes lie, seen forward; right where not given.")
    ] = None,
    out_dir: Annotated[
        Path,
        typer.Option(
            "--out", parser=output_path, help="Folder that run directories are made in.", metavar="DIR"
        ),
    ] = Path("runs"),
    resume: Annotated[
        str | None,
        typer.Option(help="Take up a run that was broken off: its name, its path, or 'last'.", metavar="RUN"),
    ] = None,
    dry_run: Annotated[
        bool,
        typer.Option(
            "--dry-run", help="Do everything, but send nothing: a remote brings the modules up and drives."
        ),
    ] = False,
    confirm: Annotated[
        str,
        typer.Option(help="Ask before these: exit (leaving a lane), switch (to the next).", metavar="LIST"),
    ] = "",
    once: Annotated[
        bool, typer.Option("--once", help="End at the first fault; else the run waits for `fieldnav ctl`.")
    ] = False,
    record: Annotated[bool, typer.Option(help="Write recording.mcap; replaying the run needs it.")] = True,
    as_json: Annotated[bool, typer.Option("--json", help="Print summary.json and nothing else.")] = False,
) -> int:
    """Drive a field with a robot, by sight.

    Everything is checked first, as `fieldnav check` does, and the robot does not move when a check fails. A
    second terminal may speak to the run: see `fieldnav ctl`. Ctrl-C stops it in good order, twice at once.

    Exit status: 0 when the mission finished, 1 when it stopped before its end or a check failed, 2 when the
    input is wrong.
    """
    from fieldnav.operator.confirmation import parse_confirmations  # noqa: PLC0415 - loads the states

    asked = parse_confirmations(confirm)
    known = _broken_off(resume, out_dir) if resume is not None else None
    order = replace(_order(robot, crop, lanes, side, known), dry_run=dry_run, once=once, confirm=asked)
    order = replace(order, record=record)
    tell = (lambda finding: None) if as_json else print_finding
    directory, summary = _drive(order, known, out_dir, tell, as_json)
    if summary is None or directory is None:
        return STOPPED
    if as_json:
        from fieldnav.journal.summary import to_json  # noqa: PLC0415

        print_json({"run": str(directory.path), **json.loads(to_json(summary))})
    else:
        from fieldnav.cli.mission_report import report  # noqa: PLC0415

        out().print(report(directory, summary))
        print_line(f"run directory: {directory.path}")
    return 0 if summary.completed else STOPPED


def _broken_off(name: str, runs: Path) -> "BrokenOff":
    from fieldnav.journal.directory import find_run  # noqa: PLC0415 - other commands need not wait for it
    from fieldnav.mission.taking_up import broken_off  # noqa: PLC0415

    return broken_off(find_run(name, runs))


def _order(
    robot: str | None,
    crop: str | None,
    lanes: int | None,
    side: SideOption | None,
    known: "BrokenOff | None",
) -> "Order":
    """What is to be driven; a run that is taken up brings its own. Raises SettingsError."""
    from drivers.wire_layout import check_nodes  # noqa: PLC0415 - see _broken_off
    from fieldnav.mission.real import Order  # noqa: PLC0415

    if known is not None:
        if lanes is not None or side is not None:
            raise SettingsError(
                "--lanes, --side: a run that is resumed keeps its own; allowed is to leave them out"
            )
        settings = known.settings
        chosen = load_crop(crop) if crop else settings.crop
        machine = load_robot(robot) if robot else settings.robot
        order = Order(chosen, machine, known.lanes, known.side, resumed=known.booking)
    else:
        if robot is None or crop is None:
            missing = "--robot" if robot is None else "--crop"
            raise SettingsError(f"{missing}: is not given; allowed is a name or the path of a file")
        given = Side.RIGHT if side is None else Side(side.value)
        order = Order(load_crop(crop), load_robot(robot), lanes or 1, given)
    check_fit(order.crop, order.robot)
    check_nodes(order.robot)
    return order


def _drive(
    order: "Order", known: "BrokenOff | None", parent: Path, tell: Callable[["Finding"], None], quiet: bool
) -> "tuple[RunDirectory | None, Summary | None]":
    """Check, then drive; nothing where a check has failed."""
    from fieldnav.cli.frames import quiet_videos  # noqa: PLC0415 - see _broken_off
    from fieldnav.cli.mission_report import reported  # noqa: PLC0415
    from fieldnav.cli.run_terminal import terminal  # noqa: PLC0415
    from fieldnav.journal.refused import begun as has_begun  # noqa: PLC0415
    from fieldnav.mission.outset import begun, cleared, silenced  # noqa: PLC0415
    from fieldnav.mission.pace import RunClock  # noqa: PLC0415
    from fieldnav.mission.real import drive  # noqa: PLC0415
    from fieldnav.preflight.gear import opened  # noqa: PLC0415

    quiet_videos()
    now_utc = datetime.now(UTC)
    clock = RunClock(known.begin_s(now_utc) if known else 0.0)
    with opened(order.robot, clock, order.record) as (found, findings):
        gear = silenced(found) if order.dry_run else found
        failed = cleared(order, gear, findings, parent, clock, time.sleep, tell)
        if failed:
            print_error(f"nothing was driven: {'; '.join(f'{each.check}: {each.figure}' for each in failed)}")
            return None, None
        directory, begun_utc = begun(order, known, parent, now_utc)
        try:
            with terminal(order.lanes, quiet) as watchers:
                return directory, drive(order, gear, directory, begun_utc, clock, watchers)
        finally:
            if has_begun(directory):
                reported(directory)
