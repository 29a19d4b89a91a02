"""Every step's evidence explains it: the conditions of its event hold, those of all the others do not."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.messages import Bound, Evidence, Side
from fieldnav.mission.simulated import Run, simulate
from fieldnav.mission.tick import Tick
from fieldnav.settings.crop import ControlLaw, CropProfile
from fieldnav.settings.field import FieldSettings, Gaps, PlacedGap, Unsown
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from states.behaviour import Step
from states.names import Event

FEWEST_STEPS = 100
"""Of the shortest mission; a frame comes every 67 ms."""
MADE_OUTSIDE = (Event.START, Event.PAUSE, Event.RESUME, Event.RESET, Event.LATCH)
"""By a person or by the loop, not by a behaviour."""


@dataclass
class Checker:
    """Watches a mission; every step that a behaviour gave must be explained."""

    explained: Callable[[Step], None]
    steps: int = 0
    events: Counter[Event] = field(default_factory=Counter)

    def watch(self, tick: Tick) -> None:
        step = tick.step
        if step.evidence or (step.event is not None and step.event not in MADE_OUTSIDE):
            self.explained(step)
            self.steps += 1
            self.events.update([step.event] if step.event else [])


def sown(name: str, lanes: int, length_m: float, seed: int = 1, **keys: object) -> FieldSettings:
    field = revised(load_field(name), {"lanes": lanes, "length_m": length_m, "seed": seed})
    return field.model_copy(update=keys)


def gaps(*places: PlacedGap) -> Gaps:
    return Gaps(placed=places)


def crop(name: str = "sugar-beet", law: ControlLaw | None = None, **row_end: float) -> CropProfile:
    profile = load_crop(name)
    control = profile.control if law is None else profile.control.model_copy(update={"law": law})
    ends = profile.row_end.model_copy(update=row_end)
    return profile.model_copy(update={"control": control, "row_end": ends})


TWO_ROWS_GONE = gaps(*(PlacedGap(lane=1, row=row, start_m=2, length_m=4) for row in (1, 2)))
ALL_ROWS_GONE = gaps(PlacedGap(lane=1, start_m=3, length_m=1.8))
MISSIONS = {
    "two lanes": (sown("demo", 2, 4), crop(), 2, Event.LANE_CENTRED),
    "ragged ends and uneven lanes": (sown("whole-field", 2, 4, 5), crop(), 2, Event.LANE_CENTRED),
    "another crop by the paper's law": (
        sown("demo", 2, 4, 3),
        crop("potato", ControlLaw.PAPER),
        2,
        Event.LAST_LANE_LEFT,
    ),
    "weeds": (sown("sim-dense-weed", 1, 4), crop(), 1, Event.LAST_LANE_LEFT),
    "a gap of all rows": (sown("demo", 1, 6, gaps=ALL_ROWS_GONE), crop(), 1, Event.ROWS_LOST),
    "rows lost for too long": (
        sown("demo", 1, 7, gaps=TWO_ROWS_GONE),
        crop(longest_gap_m=1.5),
        1,
        Event.FAIL,
    ),
    "no next lane": (sown("demo", 1, 4), crop(), 2, Event.FAIL),
    "a lane left out": (sown("demo", 3, 4, unsown=Unsown(lanes=(2,))), crop(), 3, Event.FAIL),
}


SHORT = ("two lanes", "rows lost for too long")
"""Between them they come to most states; the tests of the states explain their steps, too."""


@pytest.mark.parametrize(
    "name", [name if name in SHORT else pytest.param(name, marks=pytest.mark.long) for name in MISSIONS]
)
def test_every_step_of_a_mission_is_explained(
    name: str, explained: Callable[[Step], None], tmp_path: Path
) -> None:
    sight, profile, lanes, event = MISSIONS[name]
    checker = Checker(explained)

    robot = smaller(load_robot("bonnbot"), 4)
    simulate(Run(sight, profile, robot, lanes, Side.RIGHT, tmp_path, sketch=True), [checker])

    assert checker.events[event] >= 1, checker.events
    assert checker.steps > FEWEST_STEPS


def test_a_watched_mission_would_show_evidence_that_lies(explained: Callable[[Step], None]) -> None:
    held = Evidence("way", 2.0, 1.0, "m", Event.FAIL, Bound.ABOVE)
    failed = Evidence("time", 2.0, 3.0, "s", Event.FAIL, Bound.ABOVE)

    for lying in (
        Step(evidence=(held,)),
        Step(event=Event.FAIL, evidence=(held, failed)),
        Step(event=Event.FAIL),
    ):
        with pytest.raises(AssertionError):
            explained(lying)
