"""`bench picture-watch`: how often good pictures are taken for bad ones, over many kilometres of every field.

The robot drives by the truth, so that nothing but the watch is in question: up and down the lanes, with a
standstill and a sidestep between them, by the wheels' own errors, shaken, on a slope. Each frame of the
camera that guides is looked at as in a mission, and the speed is what the watch leaves of it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import cycle
from math import ceil, hypot, pi

import cv2

from fieldnav.control.kinematics import wheel_setpoints
from fieldnav.errors import DriverError
from fieldnav.evaluation.benchmark import Better, Figure, Plan, Progress
from fieldnav.evaluation.campaign import Failed, run_campaign
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.evaluation.row_end_robot import ObedientWheels, TickingWorld
from fieldnav.messages import STANDSTILL, CameraName, Direction, Motion, Side, Steering, Twist
from fieldnav.mission.picture_watch import PictureWatch
from fieldnav.mission.travel import Travel
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.field import FieldSettings
from fieldnav.settings.kinds import Kind
from fieldnav.settings.loading import load_crop, load_field, load_robot, names_of, revised
from fieldnav.settings.robot import Robot
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import sow
from fieldnav.simulation.renderer import FieldRenderer
from fieldnav.simulation.sketch import SketchRenderer
from fieldnav.simulation.world import module_errors

ROBOT = "bonnbot"
LENGTH_M, LANES, QUICK_LENGTH_M = 100.0, 2, 10.0
SKETCHED_KM, DRAWN_KM = 200.0, 5.0
PAST_M, STANDING_S, SIDESTEP_MPS = 1.0, 2.0, 0.15
"""Driven on past a lane's end; stood before and after a sidestep; and how fast that is."""
OFFSET_GAIN_PER_M2, HEADING_GAIN_PER_M, MAX_YAW_RATE_RPS = 1.0, 1.5, 0.3
METRES_PER_KILOMETRE = 1000.0
MOST_ALARMS = 1.0


@dataclass(frozen=True, slots=True)
class Watching:
    """A field to be driven over."""

    field: FieldSettings
    crop: CropProfile
    robot: Robot
    drawn: bool

    @property
    def title(self) -> str:
        return f"{self.field.name}, {self.crop.name}, seed {self.field.seed}"


@dataclass(frozen=True, slots=True)
class Watched:
    """What came of it; alarms: what was said against good pictures. slow_s: driven slower than asked."""

    driven_m: float
    driven_s: float
    slow_s: float
    frames: int
    alarms: tuple[str, ...]


def picture_watch_figures(
    plan: Plan,
    progress: Progress,
    processes: int = 1,
    sketched_km: float = SKETCHED_KM,
    drawn_km: float = DRAWN_KM,
) -> list[Figure]:
    """Kilometres over all shipped fields and crops, sketched and drawn; quick: some metres of a few."""
    figures = []
    for drawn, kilometres in ((False, sketched_km), (True, drawn_km)):
        jobs = _jobs(plan.seed, kilometres, drawn, plan.quick)
        name = "drawn" if drawn else "sketched"
        done = run_campaign(f"{name} fields", watch, jobs, processes, progress)
        figures += _figures(f"good pictures, {name}", done)
    return figures


def watch(job: Watching) -> Watched:
    """Drive all lanes of a field. Raises FieldnavError."""
    cv2.setNumThreads(1)
    return _Round(job).drive()


def _jobs(seed: int, kilometres: float, drawn: bool, quick: bool) -> list[Watching]:
    length_m = QUICK_LENGTH_M if quick else LENGTH_M
    count = 2 if quick else ceil(kilometres * METRES_PER_KILOMETRE / (LANES * length_m))
    cases = [(field, load_field(field).crop) for field in names_of(Kind.FIELD)]
    cases += [("demo", crop) for crop in names_of(Kind.CROP)]
    robot = load_robot(ROBOT) if drawn else smaller(load_robot(ROBOT), 4)
    return [
        Watching(_field(name, crop, length_m, seed + number), load_crop(crop), robot, drawn)
        for number, (name, crop) in zip(range(count), cycle(cases), strict=False)
    ]


def _field(name: str, crop: str, length_m: float, seed: int) -> FieldSettings:
    return revised(load_field(name), {"crop": crop, "lanes": LANES, "length_m": length_m, "seed": seed})


def _figures(case: str, done: Sequence[Watched | Failed[Watching]]) -> list[Figure]:
    driven = [each for each in done if isinstance(each, Watched)]
    alarms = [said for each in driven for said in each.alarms]
    kilometres = sum(each.driven_m for each in driven) / METRES_PER_KILOMETRE
    slow_s, all_s = sum(each.slow_s for each in driven), sum(each.driven_s for each in driven)
    return [
        Figure(case, "driven (km)", kilometres),
        Figure(case, "frames", float(sum(each.frames for each in driven))),
        Figure(case, "false alarms", float(len(alarms)), goal=MOST_ALARMS, better=Better.LOWER),
        Figure(
            case, "time at less than the speed asked for (%)", 100 * slow_s / all_s if all_s else float("nan")
        ),
        Figure(case, "fields that failed", float(len(done) - len(driven)), goal=0.0, better=Better.LOWER),
        *(Figure(f"{case}: {said}", "said", 1.0) for said in alarms),
    ]


class _Round:
    """One drive up and down the lanes of a field."""

    def __init__(self, job: Watching) -> None:
        field, self._robot, self._crop = job.field, job.robot, job.crop
        self._plan = sow(field, job.crop, Side.RIGHT)
        self._wheels = ObedientWheels(module_errors(field.wheel_errors, field.seed, field.mirrored))
        self._world = TickingWorld(self._plan, field, job.robot, self._wheels)
        renderer = (FieldRenderer if job.drawn else SketchRenderer)(self._plan, field, job.crop)
        self._cameras = {name: SimulatedCamera(name, self._world, renderer) for name in CameraName}
        self._watches = {
            name: PictureWatch(camera, job.robot.timeouts.frame_s)
            for name, camera in job.robot.cameras.pinholes().items()
        }
        self._travel = Travel(job.robot)
        self._frame_s = 1 / job.robot.cameras.front.rate_hz
        self._driven_m = self._driven_s = self._slow_s = 0.0
        self._frames, self._alarms = 0, list[str]()
        self._seen: object = None

    def drive(self) -> Watched:
        for lane, direction in zip(range(self._plan.lanes), cycle(Direction)):
            self._along(lane, direction)
            if lane + 1 < self._plan.lanes:
                self._aside(direction)
        return Watched(self._driven_m, self._driven_s, self._slow_s, self._frames, tuple(self._alarms))

    def _along(self, lane: int, direction: Direction) -> None:
        """Follow a lane by the leading camera, and leave it by the trailing one."""
        first_m, last_m = self._plan.lane_span_m(lane)
        ends_m = last_m if direction is Direction.FORWARD else -first_m
        while (place_m := self._place_m(lane, direction)) < ends_m + PAST_M:
            leaving = place_m > ends_m
            camera = direction.trailing if leaving else direction.leading
            speed_mps = self._crop.speeds.exit_mps if leaving else self._crop.speeds.follow_mps
            self._go(camera, Motion(self._following(lane, direction, speed_mps), Steering.OMNIDIRECTIONAL))

    def _aside(self, direction: Direction) -> None:
        """Stand, step to the next lane by the trailing camera, and stand again."""
        camera, twist = direction.trailing, Twist(0.0, -SIDESTEP_MPS, 0.0)
        moved_m = 0.0
        self._stand(camera)
        while moved_m < self._crop_pitch_m:
            moved_m += SIDESTEP_MPS * self._frame_s * self._watches[camera].motion.speed_share
            self._go(camera, Motion(twist, Steering.OMNIDIRECTIONAL))
        self._stand(camera)

    @property
    def _crop_pitch_m(self) -> float:
        return self._world.field.lane_pitch_m

    def _stand(self, camera: CameraName) -> None:
        for _ in range(round(STANDING_S / self._frame_s)):
            self._go(camera, Motion(STANDSTILL, Steering.OMNIDIRECTIONAL, hold=True))

    def _place_m(self, lane: int, direction: Direction) -> float:
        pose = self._world.now.pose
        return direction.sign * float(self._plan.in_lane(lane, (pose.x_m, pose.y_m))[0])

    def _following(self, lane: int, direction: Direction, speed_mps: float) -> Twist:
        """Along the lane by the truth, at a speed."""
        pose = self._world.now.pose
        _, offset_m, heading_rad = self._plan.in_lane(lane, (pose.x_m, pose.y_m))
        off_rad = _wrapped(pose.heading_rad - float(heading_rad))
        bend_per_m = -OFFSET_GAIN_PER_M2 * direction.sign * float(offset_m) - HEADING_GAIN_PER_M * off_rad
        yaw_rate_rps = max(-MAX_YAW_RATE_RPS, min(MAX_YAW_RATE_RPS, speed_mps * bend_per_m))
        return Twist(direction.sign * speed_mps, 0.0, yaw_rate_rps)

    def _go(self, camera: CameraName, motion: Motion) -> None:
        """One frame's time, and the frame."""
        motion_watch = self._watches[camera].motion
        share, twist = motion_watch.speed_share, motion.twist
        slowed = Twist(twist.vx_mps * share, twist.vy_mps * share, twist.yaw_rate_rps * share)
        self._command(Motion(slowed, motion.steering, motion.hold))
        before = self._world.now.pose
        now_s = self._world.now.stamp_s + self._frame_s
        self._world.advance(now_s)
        self._travel.measure(now_s, self._wheels.poll(now_s))
        here = self._world.now.pose
        self._driven_m += hypot(here.x_m - before.x_m, here.y_m - before.y_m)
        self._driven_s += self._frame_s
        self._slow_s += self._frame_s if share < 1 and twist != STANDSTILL else 0.0
        self._look(camera, now_s)

    def _command(self, motion: Motion) -> None:
        present = {wheel: state.steering_rad for wheel, state in self._wheels.wheel_states().items()}
        limit_rad = min(module.steering_limit_rad for module in self._robot.modules.values())
        now_s = self._world.now.stamp_s
        setpoints = wheel_setpoints(motion, self._robot.geometry, present, self._robot.limits, limit_rad)
        self._wheels.command(now_s, setpoints)

    def _look(self, camera: CameraName, now_s: float) -> None:
        frame = self._cameras[camera].latest(now_s)
        if frame is None or frame is self._seen:
            return
        self._seen, self._frames = frame, self._frames + 1
        try:
            found = self._watches[camera].objection(frame, self._travel.track)
        except DriverError as error:
            self._alarms.append(f"{self._world.field.name} {self._crop.name} at {now_s:.1f} s: {error}")
            return
        if found is not None:
            self._alarms.append(f"{self._world.field.name} {self._crop.name} at {now_s:.1f} s: {found}")


def _wrapped(angle_rad: float) -> float:
    return (angle_rad + pi) % (2 * pi) - pi
