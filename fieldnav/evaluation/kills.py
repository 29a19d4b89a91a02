"""`bench kills`: the mission's process is killed at random moments and resumed, hundreds of times."""

from dataclasses import dataclass, replace

from fieldnav.evaluation.benchmark import Progress, Report
from fieldnav.evaluation.campaign import Failed, run_campaign
from fieldnav.evaluation.kills_drive import soak
from fieldnav.evaluation.kills_figures import Outcome, failure_lines, kills_figures
from fieldnav.evaluation.kills_runs import KILLS, soak_run
from fieldnav.evaluation.kills_soaked import SoakRun
from fieldnav.evaluation.row_end_cases import smaller
from fieldnav.settings.loading import load_robot
from fieldnav.settings.robot import Robot

ROBOT = "bonnbot"
PART = "missions killed and resumed"
ALL_KILLS, QUICK_KILLS = 500, 5


@dataclass(frozen=True, slots=True)
class KillsPlan:
    """How many kills at least, the first mission's seed, and how many run side by side."""

    kills: int = ALL_KILLS
    seed: int = 1
    jobs: int = 1


def in_short(plan: KillsPlan) -> KillsPlan:
    """The same in under a minute: one mission."""
    return replace(plan, kills=QUICK_KILLS)


def kill_soak(plan: KillsPlan, progress: Progress) -> Report:
    """Drive whole missions until there were kills enough; what goes wrong is a line of the report."""
    robot = smaller(load_robot(ROBOT))
    outcomes: list[Outcome] = []
    while (left := plan.kills - killed(outcomes)) > 0:
        outcomes += run_campaign(
            PART, soak, _runs(plan.seed + len(outcomes), left, robot), plan.jobs, progress
        )
        if all(isinstance(outcome, Failed) for outcome in outcomes):
            break
    return Report(kills_figures(outcomes), failures=failure_lines(outcomes))


def killed(outcomes: list[Outcome]) -> int:
    """Kills so far."""
    return sum(outcome.kills.total() for outcome in outcomes if not isinstance(outcome, Failed))


def _runs(seed: int, kills: int, robot: Robot) -> list[SoakRun]:
    """About as many missions as it takes; none is cut short."""
    most = max(KILLS)
    return [soak_run(seed + each, robot) for each in range(-(-kills // most))]
