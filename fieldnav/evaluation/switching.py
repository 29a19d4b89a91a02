"""`bench switching`: lane switches of every crop, judged by the truth, and rows recognised by sight."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from fieldnav.evaluation.benchmark import Failure, Figure, Plan, Progress, Report
from fieldnav.evaluation.campaign import Failed, run_campaign
from fieldnav.evaluation.switching_again import again
from fieldnav.evaluation.switching_figures import switching_figures
from fieldnav.evaluation.switching_runs import Switched, SwitchRun, drive_switches, switch_run
from fieldnav.settings.loading import load_robot
from fieldnav.settings.robot import Robot

ROBOT = "bonnbot"
PART = "runs with lane switches"
SWITCHES, SWITCHES_A_RUN = 200, 5
QUICK_SWITCHES = 2


@dataclass(frozen=True, slots=True)
class SwitchingPlan:
    """What is to be driven: so many switches, so many a run, from a seed on."""

    switches: int = SWITCHES
    a_run: int = SWITCHES_A_RUN
    seed: int = 1
    jobs: int = 1
    quick: bool = False
    robot: Robot | None = None
    plots: Path | None = None


def in_short(plan: SwitchingPlan) -> SwitchingPlan:
    """The same in under a minute: two switches, each in a run of its own."""
    return replace(plan, switches=QUICK_SWITCHES, a_run=1, quick=True)


def switching(plan: SwitchingPlan, progress: Progress) -> Report:
    """Drive every run and report; a switch that fails is a line of the report. Raises FieldnavError."""
    with TemporaryDirectory(prefix="fieldnav-") as folder:
        wanted = list(_runs(plan, Path(folder)))
        results = run_campaign(PART, drive_switches, wanted, plan.jobs, progress)
    runs = [result for result in results if isinstance(result, Switched)]
    if plan.plots is not None:
        from fieldnav.evaluation.switching_plots import draw_switching  # noqa: PLC0415 - loads matplotlib

        draw_switching(plan.plots, runs)
    failures = [failure for result in results for failure in failures_of(result, plan.plots)]
    return Report((*switching_figures(runs), *_recognition(plan, progress)), failures=tuple(failures))


def _runs(plan: SwitchingPlan, folder: Path) -> Iterator[SwitchRun]:
    robot = plan.robot or load_robot(ROBOT)
    for index, done in enumerate(range(0, plan.switches, plan.a_run)):
        switches = min(plan.a_run, plan.switches - done)
        yield switch_run(plan.seed + index, switches + 1, robot, folder)


def failures_of(result: Switched | Failed[SwitchRun], folder: Path | None) -> list[Failure]:
    """A line for each switch that failed, and one for whatever else went wrong in a run."""
    if isinstance(result, Failed):
        return [Failure(result.job.title, result.reason, again(result.job, folder))]
    said = [
        f"switch from lane {switch.lane}, {switch.direction.value.lower()}: {switch.fault}"
        for switch in result.switches
        if not switch.succeeded
    ]
    if result.run_over:
        said.append(f"{result.run_over} crop plants run over")
    if result.reason:
        said.append(f"stopped: {result.reason}")
    command = again(result.wanted, folder) if said else ""
    return [Failure(result.wanted.title, reason, command) for reason in said]


def _recognition(plan: SwitchingPlan, progress: Progress) -> Sequence[Figure]:
    """Rows told apart by their features, by the bench's part for that."""
    from fieldnav.evaluation.recognition import recognition_figures  # noqa: PLC0415 - loads matplotlib

    return recognition_figures(Plan(None, plan.quick, plan.seed, plan.plots), progress)
