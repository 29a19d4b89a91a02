"""The table at the end of a run: how it ended and why, and its figures."""

from rich.table import Table

from fieldnav.cli.console import print_error, table
from fieldnav.inquiry.figure_words import against_truth, finished, lateness, missed_lanes
from fieldnav.inquiry.outcome import overview
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.summary import Summary


def report(directory: RunDirectory, summary: Summary) -> Table:
    """Everything a person wants to know of a run that has just ended."""
    rows = [("outcome", outcome_of(summary))]
    ended = overview(directory)
    if not summary.completed:
        rows += [("stopped in", ended.last_state), ("reason", ended.reason or "none in the journal")]
    rows += [
        ("lanes", f"{summary.lanes.done} of {summary.lanes.total}"),
        ("distance", f"{summary.distance_m:.1f} m in {summary.duration_s:.0f} s"),
        _pace(summary),
        ("switches", f"{summary.switches.succeeded} of {summary.switches.attempted}"),
        ("faults", str(summary.faults)),
        *(("warning", warning) for warning in summary.warnings),
    ]
    used = summary.headland_m
    if used.mean is not None:
        rows.append(("headland used", f"{used.mean:.2f} m, at most {used.max:.2f} m"))
    if summary.truth:
        rows += against_truth(summary.truth)
    return table("", ("", ""), rows)


def reported(directory: RunDirectory) -> None:
    """Write the run's report.html; where that fails a line says so, and the run is what it was."""
    from fieldnav.report.writing import write_report  # noqa: PLC0415 - a run that refuses to begin needs none

    try:
        write_report(directory)
    except Exception as error:  # the robot has done its work, whatever is wrong with the page about it
        print_error(f"{directory.report}: was not written: {error}; try: fieldnav log report")


def _pace(summary: Summary) -> tuple[str, str]:
    """How a simulation kept up with the clock, and a robot's loop with its beat."""
    loop = summary.loop
    if loop is None:
        return "speed of simulation", f"{summary.realtime_factor:.1f} x real time, {summary.wall_s:.0f} s"
    return "lateness of the loop", lateness(loop)


def outcome_of(summary: Summary) -> str:
    """How a run ended, in a few words."""
    return finished(summary) if summary.completed else "stopped before the end"


def succeeded(summary: Summary) -> bool:
    """Whether the mission ended and, as far as that is known, drove every lane."""
    return summary.completed and not missed_lanes(summary)
