"""`fieldnav log why`: what happened at a moment of a run, why, and what nearly happened instead."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fieldnav.cli.console import out, print_error, print_json
from fieldnav.cli.log.near_misses import is_recorded
from fieldnav.cli.log.options import RUN_HELP, RUNS, JsonOption, RunsOption
from fieldnav.cli.log.why_json import as_json
from fieldnav.cli.log.why_text import print_explanation
from fieldnav.errors import FieldnavError, SettingsError
from fieldnav.inquiry.asked import Asked, asked_about
from fieldnav.inquiry.headline import Headline, headline
from fieldnav.inquiry.moment import ALLOWED, Moment, clock, parse_moment
from fieldnav.journal.directory import RunDirectory, find_run

if TYPE_CHECKING:
    from fieldnav.cli.log.recorded import Recorded


def why(
    run: Annotated[str, typer.Argument(metavar="[RUN]", help=RUN_HELP)] = "last",
    moment: Annotated[
        str,
        typer.Argument(
            metavar="[TIME|SEQ]",
            help="A time such as 41.3, 41s or 1:23.4, or a line's number such as 17; without, the last stop.",
        ),
    ] = "",
    runs: RunsOption = RUNS,
    no_picture: Annotated[bool, typer.Option("--no-picture", help="Save no picture of the moment.")] = False,
    json: JsonOption = False,
) -> None:
    """Say what happened and why, in the first line; then all that was judged, and what nearly happened."""
    directory, wanted = _chosen(run, moment, runs)
    asked = asked_about(directory, wanted)
    known, lacking = _recorded(directory, asked)
    state = asked.line.source if asked.happened else asked.line.target
    said = headline(asked, known.judged(state) if known else ())
    picture = None if no_picture or known is None else _saved(directory, asked, said, known)
    if json:
        print_json(as_json(directory, asked, said, known is not None, picture))
    else:
        print_explanation(out(), asked, said, known, lacking, picture)


def _chosen(run: str, moment: str, runs: Path) -> tuple[RunDirectory, Moment | None]:
    """The run and the moment; one word alone is a moment where it looks like one. Raises FieldnavError."""
    if not moment and parse_moment(run) is not None and not RunDirectory(Path(run)).journal.exists():
        run, moment = "last", run
    wanted = parse_moment(moment) if moment else None
    if moment and wanted is None:
        raise SettingsError(f"'{moment}': is no moment of a run; allowed is {ALLOWED}")
    return find_run(run, runs), wanted


def _recorded(directory: RunDirectory, asked: Asked) -> "tuple[Recorded | None, str]":
    """The half minute before, or why nothing is known of it."""
    if not is_recorded(directory):
        return None, "this run has no recording: the journal alone is shown"
    from fieldnav.cli.log.recorded import recorded  # noqa: PLC0415 - most of a second to import
    from fieldnav.inquiry.seen import seen_of  # noqa: PLC0415

    try:
        known = recorded(directory, asked.at_s, seen_of(asked.line) if asked.happened else None)
    except FieldnavError as error:
        return None, f"the recording cannot be shown: {error}"
    if known is None or not (known.steps or known.ticks):
        return None, f"the recording has nothing of the half minute before {clock(asked.at_s)}"
    return known, ""


def _saved(directory: RunDirectory, asked: Asked, said: Headline, known: "Recorded") -> Path | None:
    """Where the picture lies; a directory that cannot be written is no failure."""
    from fieldnav.cli.log.why_picture import save_picture  # noqa: PLC0415 - see _recorded

    if known.picture is None:
        return None
    name = str(asked.line.seq) if asked.happened else f"{asked.at_s:.1f}s"
    path = directory.path / f"why-{name}.jpg"
    try:
        save_picture(path, known, said.text, said.evidence)
    except FieldnavError as error:
        print_error(str(error))
        return None
    return path
