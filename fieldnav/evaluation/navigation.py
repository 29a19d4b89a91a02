"""`bench navigation`: whole lanes of the paper's fields, driven by the default and by the paper's ways."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from fieldnav.evaluation.benchmark import Failure, Figure, LeftOut, Progress, Report
from fieldnav.evaluation.campaign import Failed, run_campaign
from fieldnav.evaluation.navigation_cases import Case, cases_of, fits, lane_of
from fieldnav.evaluation.navigation_configurations import Configuration, configured
from fieldnav.evaluation.navigation_figures import case_figures, titled
from fieldnav.evaluation.navigation_lane import Drive, Lane, drive_lane
from fieldnav.messages import Side
from fieldnav.mission.simulated import Run
from fieldnav.settings.loading import load_crop, load_robot
from fieldnav.settings.robot import Robot

ROBOT = "bonnbot"
PART = "lanes driven"
TOO_SHORT = "the lane is too short for its gap"
QUICK_FIELDS, QUICK_M = ("sim-curved", "potato"), 6.0


@dataclass(frozen=True, slots=True)
class NavigationPlan:
    """What is to be driven: fields by name, none for all; seeds from `seed` on; no length for the paper's."""

    fields: tuple[str, ...] = ()
    seed: int = 1
    seeds: int = 3
    length_m: float | None = None
    jobs: int = 1
    ways: tuple[Configuration, ...] = tuple(Configuration)
    robot: Robot | None = None
    plots: Path | None = None


def in_short(plan: NavigationPlan) -> NavigationPlan:
    """The same in under a minute: one seed of a few metres of two fields."""
    return replace(
        plan,
        fields=plan.fields or QUICK_FIELDS,
        seeds=1,
        length_m=plan.length_m or QUICK_M,
        ways=(Configuration.DEFAULT, Configuration.PAPER),
    )


def navigation(plan: NavigationPlan, progress: Progress) -> Report:
    """Drive every lane and report; a run that fails is a line of the report. Raises SettingsError."""
    chosen = cases_of(plan.fields)
    cases = [case for case in chosen if fits(case, plan.length_m)]
    with TemporaryDirectory(prefix="fieldnav-") as folder:
        drives = _drives(cases, plan, Path(folder))
        results = run_campaign(PART, drive_lane, drives, plan.jobs, progress)
    lanes = [result for result in results if isinstance(result, Lane)]
    if plan.plots is not None:
        from fieldnav.evaluation.navigation_plots import draw_navigation  # noqa: PLC0415 - loads matplotlib

        draw_navigation(plan.plots, cases, lanes)
    return Report(
        tuple(_figures(cases, lanes)),
        tuple(LeftOut(case.name, TOO_SHORT) for case in chosen if case not in cases),
        tuple(failure for result in results if (failure := failure_of(result))),
    )


def _drives(cases: Sequence[Case], plan: NavigationPlan, folder: Path) -> list[Drive]:
    """Every lane to be driven, the longest first, so that no process is left with one at the end."""
    robot = plan.robot or load_robot(ROBOT)
    drives = []
    for case in cases:
        for seed in range(plan.seed, plan.seed + plan.seeds):
            field = lane_of(case, plan.length_m, seed)
            crop = load_crop(field.crop)
            for way in plan.ways:
                run = Run(field, configured(crop, way), robot, field.lanes, Side.RIGHT, folder)
                drives.append(Drive(case, way, run))
    return sorted(drives, key=lambda drive: -drive.run.field.length_m)


def _figures(cases: Sequence[Case], lanes: Sequence[Lane]) -> list[Figure]:
    by_case = {case: [lane for lane in lanes if lane.drive.case == case] for case in cases}
    return [figure for case, its in by_case.items() if its for figure in case_figures(case, its)]


def failure_of(result: Lane | Failed[Drive]) -> Failure | None:
    """What a run that stopped, or gave no figures at all, is reported as."""
    drive = result.job if isinstance(result, Failed) else result.drive
    if isinstance(result, Lane) and not result.stops and not result.run_over:
        return None
    said = result.reason or "the mission did not end as it should"
    if isinstance(result, Lane) and result.run_over:
        said = f"{result.run_over} crop plants run over" + (f"; {result.reason}" if result.reason else "")
    field = drive.run.field
    return Failure(f"{titled(drive.case, drive.configuration)}, seed {field.seed}", said, _again(drive))


def _again(drive: Drive) -> str:
    field = drive.run.field
    if drive.configuration is Configuration.DEFAULT and not drive.case.gap_m:
        options = f"--lanes 1 --length {field.length_m:g} --seed {field.seed}"
        return f"fieldnav simulate {drive.case.field} {options}"
    options = f"--fields {drive.case.field} --length {field.length_m:g} --seed {field.seed} --seeds 1"
    return f"fieldnav bench navigation {options}"
