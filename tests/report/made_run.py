"""Made-up runs whose every figure is known, with a real journal and ledger."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Entry
from fieldnav.journal.journal import Journal
from fieldnav.journal.ledger import Booking, Ledger
from fieldnav.journal.resolved import write_settings
from fieldnav.journal.summary import Lanes, Summary, Switches, write_summary
from fieldnav.messages import CameraName, Evidence, Frame
from fieldnav.settings.loading import load_crop, load_robot
from states.names import Event

from .made_recording import BEGUN, record, state_at, stepped, ticked

STUCK = "steering stuck: module front_left stands 14 degrees from the angle it was told"
BLACK = "camera black: front camera: brightness 0 of 255, limit 10"
TRACKING, BACK = "Forward.Follow.Tracking", "Backward.Follow.Tracking"
ENDED = Evidence("probability that the lane has ended", 0.62, 0.5, "", Event.LANE_ENDED)
LEFT = (Evidence("length of this lane", 5.5, None, "m"),)


def frame(sequence: int, stamp_s: float) -> Frame:
    return Frame(CameraName.FRONT, sequence, stamp_s, np.zeros((2, 2, 3), np.uint8))


STORY = (
    Entry(0.0, "start", "Idle", "Checking", 1, 0),
    Entry(0.5, "ready", "Checking", "Forward.Follow.Acquiring", 1, 0, forward_m=0.0, sideways_m=0.0),
    Entry(1.0, "rows found", "Forward.Follow.Acquiring", TRACKING, 1, 3, forward_m=0.0, sideways_m=0.0),
    Entry(
        10.0,
        "lane ended",
        TRACKING,
        "Forward.Exit",
        1,
        3,
        (ENDED,),
        frame(100, 9.9),
        forward_m=4.5,
        sideways_m=0.0,
    ),
    Entry(
        12.0,
        "lane left",
        "Forward.Exit",
        "Forward.Sidestep.Crossing",
        1,
        3,
        LEFT,
        forward_m=6.0,
        sideways_m=0.0,
    ),
    Entry(
        20.0,
        "lane centred",
        "Forward.Sidestep.Crossing",
        "Backward.Follow.Acquiring",
        1,
        3,
        forward_m=6.0,
        sideways_m=-1.5,
    ),
    Entry(21.0, "rows found", "Backward.Follow.Acquiring", BACK, 2, 3, forward_m=6.0, sideways_m=-1.5),
    Entry(24.0, "held by the gate", BACK, BACK, 2, 3, reason=BLACK, forward_m=5.0, sideways_m=-1.5),
    Entry(26.0, "latch", BACK, "Fault.Latched", 2, 3, reason=STUCK, forward_m=4.0, sideways_m=-1.5),
)
"""A lane, a switch, and a stop in the second lane that a hold went before."""


def summary(lines: Sequence[Entry], completed: bool) -> Summary:
    return Summary(
        completed=completed,
        lanes=Lanes(done=1, total=2),
        distance_m=9.5,
        duration_s=lines[-1].stamp_s,
        wall_s=5.0,
        realtime_factor=5.2,
        transitions=len(lines),
        faults=1,
        switches=Switches(attempted=1, succeeded=1),
    )


def written(
    runs: Path,
    lines: Sequence[Entry],
    recorded: bool,
    completed: bool | None,
    name: str = "story",
    until_s: float | None = None,
) -> RunDirectory:
    """A run's directory; recorded until a time, else until its last line; without a summary for None."""
    directory = RunDirectory.create(runs, name, BEGUN)
    with Journal(directory.journal, BEGUN) as journal:
        for line in lines:
            journal.record(line)
    with Ledger(directory.ledger) as ledger:
        ledger.book(booked("Forward.Sidestep.Crossing", 7.5))
    write_settings(directory.settings, load_crop("sugar-beet"), load_robot("bonnbot"), options={"lanes": 2})
    if completed is not None:
        write_summary(directory.summary, summary(lines, completed))
    if recorded:
        times = [index / 10 for index in range(10 * int(until_s or lines[-1].stamp_s))]
        steps = [
            stepped(int(10 * at), at, lines, 0.23 if at == 5.0 else 0.0)
            for at in times
            if "Tracking" in state_at(at, lines).target
        ]
        record(directory, [ticked(at, lines) for at in times], steps)
    return directory


def booked(state: str, forward_m: float) -> Booking:
    """The lane began at 0.8 m and is 5.5 m long."""
    return Booking(
        stamp_s=13.0,
        state=state,
        side="right",
        lanes=2,
        lane=1,
        done=(1,),
        rows=3,
        forward_m=forward_m,
        sideways_m=0.0,
        lane_from_m=0.8,
        lane_length_m=5.5,
    )
