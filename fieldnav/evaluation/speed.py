"""What fieldnav costs: a simulated mission, a round of the loop, and a frame in all that is done to it."""

from collections.abc import Callable

from fieldnav.evaluation.benchmark import Figure, Plan, Progress, Report
from fieldnav.evaluation.speed_frames import crowd_figures, frame_figures
from fieldnav.evaluation.speed_loop import loop_figures
from fieldnav.evaluation.speed_mission import mission_figures
from fieldnav.evaluation.speed_sidestep import sidestep_figure
from fieldnav.evaluation.speed_soak import soak_report
from fieldnav.evaluation.speed_timing import one_thread

ROUNDS, QUICK_ROUNDS = 60, 12
LOOP_S, QUICK_LOOP_S = 60.0, 6.0  # of tracking
MISSION, QUICK_MISSION = (7, 30.0), (1, 6.0)  # lanes and their length in metres


def hour(plan: Plan, progress: Progress) -> Report:
    """One hour of a mission, in a process that has done nothing before."""
    report = soak_report(plan, progress)
    progress("speed: one hour", 1, 1)
    return report


def speed(plan: Plan, progress: Progress) -> list[Figure]:
    """Every figure of speed; the mission comes first, while this process is still small."""
    rounds = QUICK_ROUNDS if plan.quick else ROUNDS
    with one_thread():
        parts: dict[str, Callable[[], list[Figure]]] = {
            "simulated mission": lambda: mission_figures(*(QUICK_MISSION if plan.quick else MISSION), plan),
            "loop": lambda: loop_figures(QUICK_LOOP_S if plan.quick else LOOP_S),
            "frames": lambda: frame_figures(plan, rounds),
            "sidestep": lambda: [sidestep_figure(rounds)],
            "plants in view": lambda: crowd_figures(rounds),
        }
        figures = []
        for done, (part, measure) in enumerate(parts.items()):
            progress(f"speed: {part}", done, len(parts))
            figures += measure()
        progress("speed", len(parts), len(parts))
    return figures
