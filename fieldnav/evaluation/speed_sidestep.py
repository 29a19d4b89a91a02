"""What a frame costs while stepping sideways: finding plants, following the rows, and recognising one."""

from time import process_time

import numpy as np

from fieldnav.evaluation.benchmark import Better, Figure
from fieldnav.evaluation.speed_samples import CROP, FIELD, rendered_sample
from fieldnav.evaluation.speed_timing import MILLISECONDS
from fieldnav.messages import CameraName, Direction, Frame, Image, Side
from fieldnav.mission.loop import TICK_S
from fieldnav.settings.loading import load_crop
from states.behaviour import Observation, Task
from states.crossing import REFRESH_FRAMES, CrossingRows
from states.memory import LaneMemory, SwitchMemory
from states.sampling import Sampling

GOAL_MS = 25.0


def sidestep_figure(rounds: int) -> Figure:
    """What Crossing does with a frame in which it describes and compares the outermost row."""
    sample = rendered_sample(FIELD, load_crop(CROP))
    task = Task(sample.crop, dict.fromkeys(CameraName, sample.camera), Side.RIGHT, lanes=2)
    lane = LaneMemory(1, switch=SwitchMemory(started_m=0.0))
    sampling, crossing = (make(task, Direction.FORWARD, lane) for make in (Sampling, CrossingRows))
    now_s = TICK_S
    while sampling.step(_standing(sample.image, now_s)).event is None:
        now_s += TICK_S
    spent_s = []
    for turn in range(rounds * REFRESH_FRAMES):
        seen = _standing(sample.image, now_s + turn * TICK_S)
        started_s = process_time()
        crossing.step(seen)
        spent_s.append(process_time() - started_s)
    recognised = np.array(spent_s[REFRESH_FRAMES - 1 :: REFRESH_FRAMES])
    value = float(np.median(recognised)) * MILLISECONDS
    return Figure(FIELD, "sidestep frame with recognition (ms)", value, goal=GOAL_MS, better=Better.LOWER)


def _standing(image: Image, now_s: float) -> Observation:
    """A new frame of the rear camera, the robot not having moved."""
    frame = Frame(CameraName.REAR, round(now_s / TICK_S), now_s, image)
    return Observation(now_s, {CameraName.REAR: frame}, 0.0, 0.0, True, True, True)
