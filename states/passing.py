"""What every state that moves across the rows does with a frame of the trailing camera."""

from fieldnav.messages import Evidence, Frame
from fieldnav.perception.plants import find_plants
from fieldnav.perception.sidestep.following import follow
from fieldnav.perception.sidestep.lane_odds import Expected
from fieldnav.perception.sidestep.next_lane import NextLane, next_lane
from fieldnav.perception.sidestep.passing_rows import Crossing
from fieldnav.perception.sidestep.row_lines import rows_in_image
from fieldnav.perception.sidestep.wheel_motion import travelled
from states.behaviour import Observation, Sight, Task
from states.memory import LaneMemory, SwitchMemory

LIKELY = 0.9
"""Probability from which on a lane's place is believed."""
APART_M = 0.1
"""Standard deviation of a lane's distance from the profile's, or from that of the lanes before: the drill's
own, up to 15 cm, and the wheels' few per cent, which lanes before share."""


def look(task: Task, switch: SwitchMemory, frame: Frame, seen: Observation) -> tuple[Crossing, Sight]:
    """Follow the passing rows in a frame; the switch keeps them."""
    crop, camera = task.crop, task.cameras[frame.camera]
    centres = find_plants(frame.image, crop.vegetation, camera)
    at = seen.exposed_at(frame)
    moved = travelled(switch.exposed or at, at, frame.camera)
    assert switch.crossing, "Sampling begins the crossing"
    rows = switch.crossing = follow(switch.crossing, centres, moved, crop, camera)
    switch.exposed = at
    return rows, Sight(frame, rows_in_image(rows, crop, camera), centres)


def expected(task: Task, lane: LaneMemory) -> Expected:
    """Where the next lane should be: as the profile says, else as the switches before have shown."""
    longest_m = task.crop.switching.longest_sidestep_m
    pitch_m = task.crop.rows.lane_pitch_m
    if pitch_m is not None:
        return Expected(pitch_m, APART_M, longest_m)
    if lane.pitches_m:
        return Expected(sum(lane.pitches_m) / len(lane.pitches_m), APART_M, longest_m)
    return Expected(None, APART_M, longest_m)


def found(task: Task, lane: LaneMemory, rows: Crossing) -> NextLane | None:
    """The next lane among the rows; its distance is kept with the switch."""
    there = next_lane(rows, expected(task, lane), task.crop)
    if lane.switch:
        lane.switch.rows_counted = there.rows_seen if there else 0
        lane.switch.pitch_m = there.pitch_m if there else None
    return there


def lane_evidence(task: Task, lane: LaneMemory, there: NextLane | None) -> tuple[Evidence, ...]:
    """What is known of the next lane."""
    rows = task.crop.rows.per_lane
    if there is None:
        return (Evidence("rows of the next lane", 0, rows, "rows"),)
    return (
        Evidence("rows of the next lane", there.rows_seen, rows, "rows"),
        Evidence("probability of its place", there.probability, LIKELY),
        Evidence("its distance from the old lane", there.pitch_m, expected(task, lane).pitch_m, "m"),
    )
