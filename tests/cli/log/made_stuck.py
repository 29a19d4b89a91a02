"""A run that leaves a lane, and whose steering is then stuck; with a recording of every frame."""

from collections.abc import Iterator

import cv2
import numpy as np

from fieldnav.journal.entry import Entry, Judged
from fieldnav.messages import Bound, CameraName, Evidence, Frame
from fieldnav.recording.foxglove import compressed_image
from fieldnav.recording.message import Message, Topic
from fieldnav.recording.records import Gap, Line, Seen, Stepped
from states.names import Event

from .made import EXIT, START, TRACKING, Item, item, tick

HEIGHT_PX, WIDTH_PX = 180, 320
ENDED_S, HELD_S, STUCK_S = 40.0, 44.0, 45.0
RATE_S = 0.2
FRAME = Frame(CameraName.FRONT, 200, ENDED_S - RATE_S / 2, np.zeros((2, 2, 3), np.uint8))
ENDED = (
    Evidence("probability", 0.51, 0.5, fires=Event.LANE_ENDED),
    Evidence("rows seen", 3, 1.5, "rows", Event.ROWS_LOST, Bound.BELOW),
    Evidence("offset from the lane", 0.01, None, "m"),
)
SAID = "steering stuck: module front_left stands 14 degrees from the angle it was told"
STUCK = (
    Entry(0.4, "ready", "Checking", "Forward.Follow.Acquiring", 1, 0),
    Entry(1.0, "rows found", "Forward.Follow.Acquiring", TRACKING, 1, 3),
    Entry(ENDED_S, "lane ended", TRACKING, EXIT, 1, 3, ENDED, FRAME),
    Entry(STUCK_S, "latch", EXIT, "Fault.Latched", 1, 3, reason=SAID),
)


def every_frame() -> Iterator[Item]:
    """What the front camera saw, what was judged, what the wheels were told; seven pictures are missing."""
    picture = np.full((HEIGHT_PX, WIDTH_PX, 3), (72, 96, 122), np.uint8)
    jpeg = cv2.imencode(".jpg", picture)[1].tobytes()
    for number in range(1, round(STUCK_S / RATE_S)):
        now_s = number * RATE_S
        seen = Seen(camera=CameraName.FRONT, sequence=number, stamp_s=now_s - RATE_S / 2)
        data = compressed_image(CameraName.FRONT, START, jpeg)
        yield Item(Message(Topic.FRONT_IMAGE, seen.stamp_s, data, number), picture=True)
        yield item(Topic.STEP, now_s, _step(now_s, seen))
        state = TRACKING if now_s <= ENDED_S else EXIT
        yield item(Topic.TICK, now_s, tick(now_s, state=state, hold=now_s > HELD_S))
    yield item(Topic.GAP, 44.0, Gap(from_s=43.0, to_s=44.0, frames=7))


def _step(now_s: float, seen: Seen) -> Stepped:
    """The probability rises to the lane's end; then the way to where the robot is to stop is judged."""
    tracking = Judged(name="probability", value=now_s / 80 + 0.01, threshold=0.5, fires="lane ended")
    leaving = Judged(
        name="to the stop",
        value=3 - (now_s - ENDED_S) / 2,
        threshold=0,
        unit="m",
        fires="lane left",
        bound=Bound.AT_MOST,
    )
    before = now_s <= ENDED_S
    return Stepped(
        now_s=now_s,
        state=TRACKING if before else EXIT,
        lane=1,
        forward_m=now_s / 2,
        evidence=(tracking if before else leaving,),
        frame=seen,
        rows=(Line(x_top_px=150, x_bottom_px=160, confidence=1),),
    )
