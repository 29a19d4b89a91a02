"""The figures of `bench kills`: what the missions came to, and in which states they were killed."""

from collections import Counter
from collections.abc import Sequence

from drivers.simulated_module import WATCHDOG_S
from drivers.simulated_motion import DRIVE_RAMP_MPS2
from fieldnav.evaluation.benchmark import Better, Failure, Figure
from fieldnav.evaluation.campaign import Failed
from fieldnav.evaluation.kills_soaked import Soaked, SoakRun

CASE, STATES = "missions killed and resumed", "kills by state"
PERCENT = 100.0

Outcome = Soaked | Failed[SoakRun]


def kills_figures(outcomes: Sequence[Outcome]) -> tuple[Figure, ...]:
    """A mission whose world itself failed counts as not resumed; one that stops unkilled, too, does not."""
    soaked = [each for each in outcomes if isinstance(each, Soaked)]
    states = sum((each.kills for each in soaked), Counter[str]())
    hopeless = sum(bool(each.unkilled) for each in soaked)
    fair = len(outcomes) - hopeless
    resumed = sum(not each.reason for each in soaked) / fair if fair else float("nan")
    truths = [each.truth for each in soaked if each.truth is not None]
    # Lanes that a mission did not come to are missed by its not being resumed, and counted there.
    missed = sum(each.truth.lanes_missed for each in soaked if each.truth is not None and not each.reason)
    return (
        Figure(CASE, "kills", float(states.total())),
        Figure(CASE, "missions", float(len(outcomes))),
        Figure(CASE, "missions that stop without a kill, too", float(hopeless)),
        Figure(CASE, "missions resumed to the end (%)", PERCENT * resumed, goal=PERCENT),
        _none("journals and ledgers unreadable", sum(bool(each.unreadable) for each in soaked)),
        _none("lanes missed", missed),
        _none("lanes driven twice", sum(truth.lanes_repeated for truth in truths)),
        _none("crop plants run over", sum(truth.crop_plants_run_over for truth in truths)),
        _standstill(soaked),
        *(Figure(STATES, state, float(count)) for state, count in sorted(states.items())),
    )


def failure_lines(outcomes: Sequence[Outcome]) -> tuple[Failure, ...]:
    """What went wrong, and the command that drives that mission again; kills come about when they came."""
    lines = []
    for outcome in outcomes:
        run = outcome.job if isinstance(outcome, Failed) else outcome.run
        said = [outcome.reason] if isinstance(outcome, Failed) else outcome.faults
        again = f"fieldnav bench kills --kills 1 --seed {run.field.seed}"
        lines += [Failure(run.title, reason, again) for reason in said]
    return tuple(lines)


def _standstill(soaked: Sequence[Soaked]) -> Figure:
    """Against the watchdog and the ramp of the fastest wheel that was killed, the bus's delay included."""
    slowest = max((each.standstill_s for each in soaked), default=float("nan"))
    fastest_mps = max((each.fastest_mps for each in soaked), default=0.0)
    delay_s = max((each.delay_s for each in soaked), default=0.0)
    goal = WATCHDOG_S + delay_s + fastest_mps / DRIVE_RAMP_MPS2
    return Figure(CASE, "slowest standstill after a kill (s)", slowest, goal=goal, better=Better.LOWER)


def _none(metric: str, count: int) -> Figure:
    return Figure(CASE, metric, float(count), goal=0.0, better=Better.LOWER)
