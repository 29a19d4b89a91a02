"""The journal of a run that leaves a lane and latches, and a recording in which rows were nearly lost."""

from fieldnav.journal.entry import Entry, Judged
from fieldnav.messages import Bound, Evidence
from fieldnav.recording.message import Topic
from fieldnav.recording.records import Stepped
from states.names import Event

from .made import EXIT, TRACKING, Item, item, tick

ENDED = Evidence("probability", 0.52, 0.5, fires=Event.LANE_ENDED)
AGREED = Evidence("frames that agree", 4, 4, "frames", Event.ROWS_FOUND)
LATCHED = (
    Entry(
        1.0,
        "rows found",
        "Forward.Follow.Acquiring",
        TRACKING,
        1,
        3,
        (AGREED,),
        forward_m=0.0,
        sideways_m=0.0,
    ),
    Entry(11.0, "held by the gate", TRACKING, TRACKING, 1, 3, reason="camera black: front", forward_m=5.0),
    Entry(21.0, "lane ended", TRACKING, EXIT, 1, 3, (ENDED,), forward_m=10.0, sideways_m=0.0),
    Entry(23.5, "latch", EXIT, "Fault.Latched", 1, 3, reason="bus off: gone", forward_m=11.0, sideways_m=0.0),
)
NEAR = Judged(name="rows seen", value=1.6, threshold=1.5, unit="rows", fires="rows lost", bound=Bound.BELOW)
FAR = NEAR.model_copy(update={"value": 3.0})


def nearly_lost() -> list[Item]:
    """Rows that were nearly lost at 5 s, and three ticks."""
    items = []
    for now_s, judged in ((4.0, FAR), (5.0, NEAR), (6.0, FAR)):
        step = Stepped(now_s=now_s, state=TRACKING, lane=1, forward_m=now_s / 2, evidence=(judged,))
        told = tick(now_s, modules={"front_left": {"speed_mps": 0.49}})
        items += [item(Topic.STEP, now_s, step), item(Topic.TICK, now_s, told)]
    return items
