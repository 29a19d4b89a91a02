"""What a frame costs: finding, tracking and recognising rows, the loop, and a whole simulated mission.

Times are this process's on its processor, so that neither other programs nor waiting count; OpenCV has one
thread. Works that are compared take turns, and the median over the rounds stands for each.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from math import ceil, radians, sqrt
from pathlib import Path
from resource import getpagesize
from tempfile import TemporaryDirectory
from time import process_time

import cv2
import numpy as np

from drivers.can_log import open_virtual_pair
from drivers.ports import Camera
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.evaluation.benchmark import Better, Figure, Plan, Progress
from fieldnav.evaluation.near_nadir import PROFILES
from fieldnav.evaluation.near_nadir_truth import photographs_in
from fieldnav.evaluation.photographs import PhotographSet, read_photograph
from fieldnav.evaluation.rendered_rows import Place, Scene
from fieldnav.journal.journal import Journal
from fieldnav.messages import CameraName, Direction, Floats, Frame, Image, Side
from fieldnav.mission.loop import TICK_S, Mission
from fieldnav.mission.simulated import EPOCH, Run, simulate
from fieldnav.mission.tick import Tick
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.lane import comb_m
from fieldnav.perception.perceive import find
from fieldnav.perception.plants import find_plants
from fieldnav.perception.tracking import TrackedRows, track
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from fieldnav.settings.loading import load_crop, load_field, load_robot, revised
from fieldnav.simulation.camera import SimulatedCamera
from fieldnav.simulation.plan import sow
from fieldnav.simulation.renderer import FieldRenderer
from fieldnav.simulation.world import World, module_errors
from states.behaviour import Observation, Task
from states.crossing import REFRESH_FRAMES, CrossingRows
from states.memory import LaneMemory, SwitchMemory
from states.names import Follow
from states.sampling import Sampling

Work = Callable[[], object]

ROBOT, FIELD = "bonnbot", "demo"
ROUNDS, QUICK_ROUNDS = 60, 12
PHOTOGRAPH_ROUNDS, QUICK_PHOTOGRAPH_ROUNDS = 15, 3  # of each photograph
FRESH_GOAL, TRACKING_GOAL = 1.5, 1.0  # over the bare primitives
REFERENCE_FRESH_MS, REFERENCE_TRACKING_MS = 57.0, 17.0
REFERENCE = "reference implementation, the least of its range on a machine like this"
SIDESTEP_GOAL_MS, LOOP_GOAL_MS, LOOP_PERCENTILE = 25.0, 15.0, 99
EARLY = 0.25  # share of the frames that is early; as many are late
LATE_GOAL = 1.1  # no growth; a tenth is how well two medians can be told apart
REAL_TIME_GOAL, GAZEBO_REAL_TIME, GAZEBO = 4.0, 1.0, "Gazebo at best"
MEMORY_GOAL_MB, METER_S = 400.0, 1.0
CACHES_FILLED = 2 / 3  # of the mission: from then on what memory still grows by is a leak
LOOP_S, QUICK_LOOP_S, APPROACH_S = 60.0, 6.0, 12.0  # of tracking; of getting there, and of lane left over
MISSION, QUICK_MISSION = (7, 30.0), (1, 6.0)  # lanes and their length in metres
EMERGED = {
    "rows": {"per_lane": 8, "spacing_m": 0.125},  # as farms drill it
    "plants": {"spacing_m": 0.02, "canopy_width_m": 0.03, "canopy_height_m": 0.06},
}
WEEDY = {"per_m2": 60.0, "size_m": [0.02, 0.04], "patches": 0.0}  # together some 250 plants in view
STREWN = (50, 120, 200, 300, 400, 500)  # plants in view
STREWN_RADIUS_M = 0.012  # of a plant; just above the profile's smallest area
STREWN_PLACE = (0.35, 0.65)  # of its cell's width and height, where a plant may stand
SOIL_BGR, LEAF_BGR, GRAIN = (72, 96, 122), (50, 150, 70), 3.0  # colours, and their noise in grey levels
WORKING_TILT_RAD = radians(65)  # paper
FULL = 255
MILLISECONDS, MEGABYTE, HOUR_S = 1000.0, 1e6, 3600.0
STATM = Path("/proc/self/statm")


@dataclass(frozen=True, slots=True)
class Sample:
    """A picture, 1280x720, of a crop, and the camera that took it."""

    image: Image
    crop: CropProfile
    camera: Pinhole


def speed(plan: Plan, progress: Progress) -> list[Figure]:
    """Every figure of speed; the mission comes first, while this process is still small."""
    with one_thread():
        parts: dict[str, Callable[[], list[Figure]]] = {
            "simulated mission": lambda: mission_figures(*(QUICK_MISSION if plan.quick else MISSION), plan),
            "loop": lambda: loop_figures(QUICK_LOOP_S if plan.quick else LOOP_S),
            "frames": lambda: frame_figures(plan),
            "sidestep": lambda: [sidestep_figure(QUICK_ROUNDS if plan.quick else ROUNDS)],
            "plants in view": lambda: crowd_figures(QUICK_ROUNDS if plan.quick else ROUNDS),
        }
        figures = []
        for done, (part, measure) in enumerate(parts.items()):
            progress(f"speed: {part}", done, len(parts))
            figures += measure()
        progress("speed", len(parts), len(parts))
    return figures


@contextmanager
def one_thread() -> Iterator[None]:
    """Hold OpenCV to one thread for a while."""
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        yield
    finally:
        cv2.setNumThreads(threads)


def medians_ms(works: Sequence[Work], rounds: int) -> Floats:
    """What each work costs, in ms of processor time, shape (works,); a round before the first warms up."""
    spent_s = np.empty((rounds + 1, len(works)))
    for turn in spent_s:
        for place, work in enumerate(works):
            started_s = process_time()
            work()
            turn[place] = process_time() - started_s
    return np.asarray(np.median(spent_s[1:], axis=0) * MILLISECONDS)


def bare_primitives(image: Image) -> object:
    """The least that any finder of plants does at full resolution: excess green, Otsu, connected regions."""
    blue, green, red = cv2.split(image)
    excess = cv2.subtract(green, cv2.addWeighted(red, 1 / 2, blue, 1 / 2, 0))
    _, mask = cv2.threshold(excess, 0, FULL, cv2.THRESH_OTSU)
    return cv2.connectedComponentsWithStats(mask)


def tracking_in(sample: Sample) -> Work:
    """Tracking in the next frame of the rows of a lane straight under the robot."""
    image, crop, camera = sample.image, sample.crop, sample.camera
    plane = canopy_plane(camera, crop)
    rows = tuple(plane.row_in_image(place, 0.0) for place in comb_m(crop))
    before = TrackedRows(rows, (0.0,) * len(rows), (0,) * len(rows), 0.0)

    def work() -> object:
        centres = find_plants(image, crop.vegetation, camera)
        return track(before, centres, TICK_S, crop, camera)

    return work


def frame_ms(sample: Sample, rounds: int) -> Floats:
    """Milliseconds of the bare primitives, of a fresh frame and of tracking, shape (3,)."""
    image, crop, camera = sample.image, sample.crop, sample.camera
    works = (lambda: bare_primitives(image), lambda: find(image, crop, camera), tracking_in(sample))
    return medians_ms(works, rounds)


def frame_figures(plan: Plan) -> list[Figure]:
    """Fresh frames and tracked ones against the bare primitives: rendered, and photographs where given."""
    rounds = QUICK_ROUNDS if plan.quick else ROUNDS
    crowded, usual = crowded_sample(), rendered_sample(FIELD, load_crop("sugar-beet"))
    plants = len(find_plants(crowded.image, crowded.crop.vegetation, crowded.camera))
    figures = [Figure("250 plants", "plants in view", plants)]
    figures += _cost_figures("250 plants", [crowded], rounds) + _cost_figures(FIELD, [usual], rounds)
    folder = PhotographSet.NEAR_NADIR.folder(plan)
    if folder is not None:
        camera = load_robot(ROBOT).cameras.front.pinhole()
        photographed = [
            Sample(read_photograph(each.path), load_crop(PROFILES[each.crop]), camera)
            for each in photographs_in(folder)
        ]
        rounds = QUICK_PHOTOGRAPH_ROUNDS if plan.quick else PHOTOGRAPH_ROUNDS
        figures += _cost_figures("photographs", photographed, rounds)
    return figures


def _cost_figures(case: str, samples: Sequence[Sample], rounds: int) -> list[Figure]:
    """Mean over pictures of each one's medians and ratios."""
    spent_ms = np.array([frame_ms(sample, rounds) for sample in samples])
    ratio = spent_ms[:, 1:] / spent_ms[:, :1]
    bare, fresh, tracked = (_spread(column) for column in spent_ms.T)
    over = [_spread(column) for column in ratio.T]
    low = Better.LOWER
    return [
        Figure(case, "fresh frame over bare primitives", *over[0], FRESH_GOAL, better=low),
        Figure(case, "tracking over bare primitives", *over[1], TRACKING_GOAL, better=low),
        Figure(case, "bare primitives (ms)", *bare, better=low),
        Figure(case, "fresh frame (ms)", *fresh, None, REFERENCE_FRESH_MS, REFERENCE, low),
        Figure(case, "tracking (ms)", *tracked, None, REFERENCE_TRACKING_MS, REFERENCE, low),
    ]


def _spread(values: Floats) -> tuple[float, float | None]:
    return float(values.mean()), float(values.std()) if len(values) > 1 else None


def rendered_sample(field_name: str, crop: CropProfile, **changes: object) -> Sample:
    """The middle of the first lane of a shipped field, with a crop sown in it."""
    field = revised(load_field(field_name), changes)
    scene = Scene(field, crop, sow(field, crop, Side.RIGHT), ROBOT)
    shot = scene.shoot(Place(0, field.length_m / 2), WORKING_TILT_RAD, np.random.default_rng(field.seed))
    return Sample(shot.image, crop, shot.camera)


def crowded_sample() -> Sample:
    """Winter wheat just emerged, among weeds: some 250 plants that stand apart."""
    return rendered_sample(FIELD, revised(load_crop("winter-wheat"), EMERGED), weeds=WEEDY)


def strewn_sample(count: int) -> Sample:
    """So many round plants on bare soil, each in a cell of its own so that none touch."""
    random, crop = np.random.default_rng(count), load_crop("sugar-beet")
    camera = load_robot(ROBOT).cameras.front.pinhole()
    cell_px = sqrt(camera.width_px * camera.height_px / count)
    across, down = ceil(camera.width_px / cell_px), ceil(camera.height_px / cell_px)
    cells = np.stack(np.divmod(random.permutation(across * down)[:count], across)[::-1], axis=-1)
    places = (cells + random.uniform(*STREWN_PLACE, cells.shape)) / (across, down)
    image = np.full((camera.height_px, camera.width_px, 3), SOIL_BGR, np.uint8)
    for x, y in places * (camera.width_px, camera.height_px):
        radius_px = STREWN_RADIUS_M * float(camera.pixels_per_metre(y))
        cv2.circle(image, (round(x), round(y)), round(radius_px), LEAF_BGR, cv2.FILLED)
    grain = random.normal(0, GRAIN, image.shape)
    return Sample(np.asarray((image + grain).clip(0, FULL), dtype=np.uint8), crop, camera)


def crowd_figures(rounds: int) -> list[Figure]:
    """The cost of a plant among many over that among few, by a parabola through all the pictures' costs."""
    samples = [strewn_sample(count) for count in STREWN]
    plants = np.array([len(find_plants(s.image, s.crop.vegetation, s.camera)) for s in samples], float)
    spent_ms = np.array([frame_ms(sample, rounds)[1:] for sample in samples])
    ends = np.array([STREWN[0], STREWN[-1]], float)
    figures = []
    for part, column in zip(("fresh frame", "tracking"), spent_ms.T, strict=True):
        few_ms, many_ms = np.polyval(np.polyfit(plants, column, 2), ends) / ends
        metric = f"{part}, cost a plant with {STREWN[-1]} in view over with {STREWN[0]}"
        figures.append(Figure("plants in view", metric, many_ms / few_ms, goal=1.0, better=Better.LOWER))
    return figures


def sidestep_figure(rounds: int) -> Figure:
    """What Crossing does with a frame in which it describes and compares the outermost row."""
    sample = rendered_sample(FIELD, load_crop("sugar-beet"))
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
    return Figure(
        FIELD, "sidestep frame with recognition (ms)", value, goal=SIDESTEP_GOAL_MS, better=Better.LOWER
    )


def _standing(image: Image, now_s: float) -> Observation:
    """A new frame of the rear camera, the robot not having moved."""
    frame = Frame(CameraName.REAR, round(now_s / TICK_S), now_s, image)
    return Observation(now_s, {CameraName.REAR: frame}, 0.0, 0.0, True, True, True)


class DrawnBefore:
    """A simulated camera that draws when it is told to, so that the loop finds its frames ready."""

    def __init__(self, camera: Camera) -> None:
        self._camera = camera
        self.frame: Frame | None = None

    def draw(self, now_s: float) -> bool:
        """Draw the newest picture that has arrived; whether it is another than before."""
        before, self.frame = self.frame, self._camera.latest(now_s)
        return self.frame is not before

    def latest(self, now_s: float) -> Frame | None:
        return self.frame

    def close(self) -> None:
        """Nothing to give back."""


def loop_figures(tracking_s: float) -> list[Figure]:
    """Frame in to CAN frames out while tracking, and whether that grows as the mission goes on."""
    spent_ms = loop_ms(tracking_s)
    part = max(1, int(len(spent_ms) * EARLY))
    growth = float(np.median(spent_ms[-part:]) / np.median(spent_ms[:part]))
    worst = float(np.percentile(spent_ms, LOOP_PERCENTILE))
    return [
        Figure(
            FIELD,
            "frame in to CAN frame out, 99th percentile (ms)",
            worst,
            None,
            LOOP_GOAL_MS,
            better=Better.LOWER,
        ),
        Figure(
            FIELD, "frame in to CAN frame out, median (ms)", float(np.median(spent_ms)), better=Better.LOWER
        ),
        Figure(
            FIELD, "cost of a frame late in a lane over early", growth, None, LATE_GOAL, better=Better.LOWER
        ),
    ]


def loop_ms(tracking_s: float) -> Floats:
    """Processor time of each round of the loop in which Tracking got a frame, shape (n,)."""
    crop, robot = load_crop("sugar-beet"), load_robot(ROBOT)
    length_m = (tracking_s + APPROACH_S) * crop.speeds.follow_mps
    field = revised(load_field(FIELD), {"length_m": length_m, "lanes": 1})
    plan = sow(field, crop, Side.RIGHT)
    with ExitStack() as stack:
        folder = Path(stack.enter_context(TemporaryDirectory()))
        host, far_end = open_virtual_pair()
        stack.callback(far_end.shutdown)
        stack.callback(host.shutdown)
        errors = module_errors(field.wheel_errors, field.seed, field.mirrored)
        modules = SimulatedModules(robot, far_end, errors, field.wheel_errors.can_delay_s)
        world, renderer = World(plan, field, robot, modules), FieldRenderer(plan, field, crop)
        cameras = {name: DrawnBefore(SimulatedCamera(name, world, renderer)) for name in CameraName}
        journal = stack.enter_context(Journal(folder / "journal.jsonl", EPOCH))
        pinholes = {name: robot.cameras.get(name).pinhole() for name in CameraName}
        task = Task(crop, pinholes, Side.RIGHT, lanes=1)
        mission = Mission(robot, task, cameras, ThorvaldWheels(robot, host), journal)
        return _timed(mission, world, cameras, tracking_s)


def _timed(
    mission: Mission, world: World, cameras: Mapping[CameraName, DrawnBefore], seconds: float
) -> Floats:
    """Drive forward; ms of the rounds in which Tracking got a frame, after the world went on and drew."""
    mission.start(0.0)
    spent_s = []
    for tick in range(1, round((seconds + APPROACH_S / 2) / TICK_S)):
        now_s = tick * TICK_S
        world.advance(now_s)
        drawn = {name for name, camera in cameras.items() if camera.draw(now_s)}
        fresh = CameraName.FRONT in drawn and mission.machine.leaf[-1] is Follow.TRACKING
        started_s = process_time()
        mission.tick(now_s)
        if fresh:
            spent_s.append(process_time() - started_s)
    return np.array(spent_s) * MILLISECONDS


@dataclass(slots=True)
class Meter:
    """Watches a mission: a row (time, processor's time, memory) a second, so as to hold little itself."""

    rows: list[tuple[float, float, float]]

    def watch(self, tick: Tick) -> None:
        if not self.rows or tick.now_s - self.rows[-1][0] >= METER_S:
            self.rows.append((tick.now_s, process_time(), memory_mb()))


def memory_mb() -> float:
    """What this process holds in memory; NaN where the system does not tell as Linux does."""
    if not STATM.exists():
        return float("nan")
    return int(STATM.read_text(encoding="ascii").split()[1]) * getpagesize() / MEGABYTE


def mission_figures(lanes: int, length_m: float, plan: Plan) -> list[Figure]:
    """A simulated mission, pictures drawn and rows found at full size: how fast, and how its memory grows."""
    field = revised(load_field(FIELD), {"lanes": lanes, "length_m": length_m, "seed": plan.seed})
    meter = Meter([])
    with TemporaryDirectory() as folder:
        run = Run(field, load_crop("sugar-beet"), load_robot(ROBOT), lanes, Side.RIGHT, Path(folder))
        simulate(run, [meter])
    now_s, spent_s, held_mb = np.array(meter.rows).T
    factor = float((now_s[-1] - now_s[0]) / (spent_s[-1] - spent_s[0]))
    figures = [
        Figure(
            FIELD, "simulated mission (x real time)", factor, None, REAL_TIME_GOAL, GAZEBO_REAL_TIME, GAZEBO
        )
    ]
    if plan.quick or not np.isfinite(held_mb).all():
        return figures
    later = now_s > now_s[-1] * CACHES_FILLED
    growth_mb = float(np.polyfit(now_s[later], held_mb[later], 1)[0] * HOUR_S)
    hour_mb = float(held_mb[-1] + growth_mb * max(0.0, 1 - now_s[-1] / HOUR_S))
    metric = "memory after an hour, from its growth so far (MB)"
    return [
        *figures,
        Figure(FIELD, "memory, growth in an hour (MB)", growth_mb, better=Better.LOWER),
        Figure(FIELD, metric, hour_mb, goal=MEMORY_GOAL_MB, better=Better.LOWER),
    ]
