"""How the figures of a run's summary read."""

from fieldnav.inquiry.words import counted
from fieldnav.journal.summary import LoopHealth, Summary, Truth


def finished(summary: Summary | None) -> str:
    """Of a mission that came to its end; in simulation also what the robot could not know."""
    missed = missed_lanes(summary)
    return f"finished, but {counted(missed, 'lane was', 'lanes were')} missed" if missed else "finished"


def missed_lanes(summary: Summary | None) -> int:
    """Of those driven over; 0 where nobody knows."""
    return summary.truth.lanes_missed if summary and summary.truth else 0


def lateness(loop: LoopHealth) -> str:
    """How late the loop's rounds began."""
    late = f"99 % within {loop.late_p99_ms:.1f} ms, at most {loop.late_max_ms:.1f} ms"
    return f"{late}, {counted(loop.rounds, 'round')}"


def against_truth(truth: Truth) -> list[tuple[str, str]]:
    """What only a simulation can tell: a label and a value each."""
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
