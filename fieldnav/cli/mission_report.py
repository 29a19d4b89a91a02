"""The table at the end of a run: how it ended and why, and its figures."""

from rich.table import Table

from fieldnav.cli.console import print_error, table
from fieldnav.inquiry.outcome import overview
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.summary import Summary, Truth

Rows = list[tuple[str, str]]


def report(directory: RunDirectory, summary: Summary) -> Table:
    """Everything a person wants to know of a run that has just ended."""
    rows: Rows = [("outcome", outcome_of(summary))]
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
    late = f"99 % within {loop.late_p99_ms:.0f} ms, at most {loop.late_max_ms:.0f} ms"
    return "lateness of the loop", f"{late}, {loop.rounds} rounds"


def outcome_of(summary: Summary) -> str:
    """How a run ended, in a few words; in simulation also what the robot could not know."""
    if not summary.completed:
        return "stopped before the end"
    missed = _missed(summary)
    return (
        f"finished, but {missed} lane{' was' if missed == 1 else 's were'} missed" if missed else "finished"
    )


def succeeded(summary: Summary) -> bool:
    """Whether the mission ended and, as far as that is known, drove every lane."""
    return summary.completed and not _missed(summary)


def _missed(summary: Summary) -> int:
    return summary.truth.lanes_missed if summary.truth else 0


def against_truth(truth: Truth) -> Rows:
    """What only a simulation can tell."""
    track, heading = truth.cross_track_cm, truth.heading_deg
    if track.mean is None:
        errors = [("cross-track error", "unknown: nothing was driven within the rows")]
    else:
        off = f"{track.mean} +- {track.std} cm, 95 % within {track.p95}, at most {track.max}"
        turned = f"{heading.mean} +- {heading.std} deg, at most {heading.max}"
        errors = [("cross-track error", off), ("heading error", turned)]
    return [
        *errors,
        ("crop plants run over", str(truth.crop_plants_run_over)),
        ("lanes missed, repeated", f"{truth.lanes_missed}, {truth.lanes_repeated}"),
    ]
