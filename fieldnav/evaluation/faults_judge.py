"""Whether a pair has ended as declared, and if not, what went wrong in one line."""

from collections import deque
from itertools import pairwise
from math import isnan

from drivers.simulated_module import WATCHDOG_S
from drivers.simulated_motion import DRIVE_RAMP_MPS2
from fieldnav.evaluation.faults_expected import MOVING, TARGETS, TOLD_AT_REST, Expected
from fieldnav.evaluation.faults_injection import BROKEN, PASSES_S, Injection
from fieldnav.evaluation.faults_rig import Rig
from fieldnav.evaluation.faults_witness import Moment, Witness
from fieldnav.faults import FAULTS, FaultKind
from fieldnav.mission.loop import TICK_S
from states.names import text
from states.table import FINISHED, LATCHED, PAUSED, RECOVERABLE

MOST_OFFSET_M = 0.3
"""Further from the lane's middle the robot has left it."""
SLOWER_SHARE, SLOWED_AFTER_S, ASKED_MPS, NOTHING_MPS = 0.75, 3.0, 0.05, 0.01
"""At five frames a second two thirds of the speed are left; so long after it has been told that is so."""
RAMP_S = 0.5
"""So long the gate may take from one speed to the next that is wanted."""
SPARE_S = 2 * TICK_S
"""Of a watchdog: the delay of the bus and the modules' own tick."""
STOPPED = (PAUSED, RECOVERABLE, LATCHED)


def problem(rig: Rig, injection: Injection, wanted: Expected, witness: Witness) -> str:
    """What went wrong; empty when nothing did."""
    return _harm(injection, witness) or _otherwise(rig, injection, wanted, witness)


def _harm(injection: Injection, witness: Witness) -> str:
    if witness.run_over:
        return f"{witness.run_over} crop plants run over"
    if witness.stale_commands:
        return f"{witness.stale_commands} commands to move on stale sight"
    if witness.offset_m > MOST_OFFSET_M:
        return f"{witness.offset_m:.2f} m from the middle of the lane"
    return ""


def _otherwise(  # noqa: PLR0911 - one a way to end
    rig: Rig, injection: Injection, wanted: Expected, witness: Witness
) -> str:
    match wanted:
        case Expected.GOES_ON:
            return _goes_on(rig, injection, witness)
        case Expected.SLOWER:
            return _silent(injection, witness) or _slower(rig, witness)
        case Expected.HELD:
            return _held(rig, injection, witness)
        case Expected.MODULES_STOP:
            return _modules_stop(witness)
        case Expected.UNTOUCHED:
            return "" if rig.leaf not in STOPPED else _silent(injection, witness)
        case Expected.STANDS:
            return _stands(rig, injection, witness)
    return _ends(rig, injection, wanted, witness)


def _ends(rig: Rig, injection: Injection, wanted: Expected, witness: Witness) -> str:
    targets = {TARGETS[wanted], *(TARGETS[MOVING[FAULTS[each].reaction]] for each in injection.instead)}
    if injection.fault is FaultKind.DISK_FULL and rig.broken_off and witness.stands:
        return _silent(injection, witness)  # the run is over, whatever state could still be written down
    if injection.fault is FaultKind.STEERING_STUCK and rig.leaf == FINISHED:
        return ""  # it never had to turn any more
    if rig.leaf not in targets:
        because = rig.paper.lines()[-1].reason or "nothing"
        return f"ended in {text(rig.leaf)}, not in {text(TARGETS[wanted])}; the journal's last: {because}"
    return _silent(injection, witness) or ("" if witness.stands else "the wheels do not stand")


def _silent(injection: Injection, witness: Witness) -> str:
    if witness.noticed(injection.rightly) is not None:
        return ""
    last = next((line.reason for line in reversed(witness.lines()) if line.reason), "nothing")
    return f"the journal does not name it, but says: {last}"


def _goes_on(rig: Rig, injection: Injection, witness: Witness) -> str:
    if rig.leaf in STOPPED:
        return f"stopped in {text(rig.leaf)}: {rig.paper.lines()[-1].reason}"
    return _silent(injection, witness) or _stamps(rig)


def _stamps(rig: Rig) -> str:
    """Journal stamps rise, and the hour goes by them, whatever the wall clock does."""
    lines = rig.paper.lines()
    apart = [
        (later.utc - line.utc).total_seconds() - (later.stamp_s - line.stamp_s)
        for line, later in pairwise(lines)
    ]
    return "the journal's hours jump" if any(abs(each) > SPARE_S for each in apart) else ""


def _slower(rig: Rig, witness: Witness) -> str:
    line = next(line for line in witness.lines() if line.event == FaultKind.CAMERA_SLOW.value)
    slowed = [each for each in witness.moments if _must_be_slow(each, line.stamp_s + SLOWED_AFTER_S, witness)]
    wanted_mps = deque[float](maxlen=round(RAMP_S / TICK_S))
    fast = []
    for each in slowed:
        wanted_mps.append(each.wanted_mps)
        if each.passed_mps > SLOWER_SHARE * max(wanted_mps) + NOTHING_MPS:
            fast.append(each)
    if fast:
        return f"{fast[0].passed_mps:.2f} m/s of {fast[0].wanted_mps:.2f} in {text(fast[0].leaf)}"
    return f"stopped in {text(rig.leaf)}: {rig.paper.lines()[-1].reason}" if rig.leaf in STOPPED else ""


def _must_be_slow(moment: Moment, from_s: float, witness: Witness) -> bool:
    """Guided by the same cameras as when the fault struck, and asked to move."""
    same = set(moment.guides) & set(witness.moments[0].guides)
    return moment.now_s > from_s and bool(same) and moment.wanted_mps > ASKED_MPS


def _held(rig: Rig, injection: Injection, witness: Witness) -> str:
    stopped = next((each for each in witness.moments if each.leaf in STOPPED), None)
    if stopped is not None:
        said = next((line.reason for line in reversed(witness.lines()) if line.reason), "nothing")
        return f"went to {text(stopped.leaf)} although it passed: {said}"
    after = [each for each in witness.moments if each.now_s > witness.struck_s + PASSES_S]
    gone_on = any(not each.told_zero or each.leaf != after[0].leaf for each in after)
    return "" if gone_on or rig.leaf == FINISHED else "did not go on after it had passed"


def _modules_stop(witness: Witness) -> str:
    took_s = witness.standing_after_s(witness.struck_s)
    allowed_s = WATCHDOG_S + witness.speed_mps / DRIVE_RAMP_MPS2 + SPARE_S
    if isnan(took_s) or took_s > allowed_s:
        return f"the wheels stood after {took_s:.2f} s, allowed are {allowed_s:.2f}"
    return ""


def _stands(rig: Rig, injection: Injection, witness: Witness) -> str:
    if rig.leaf != witness.leaf and rig.leaf not in (LATCHED,):
        return f"went to {text(rig.leaf)}"
    if injection.fault is FaultKind.DRIVE_RUNAWAY:
        return "" if witness.stands else f"module {BROKEN.value} still runs"
    unsaid = _silent(injection, witness) if injection.fault in TOLD_AT_REST else ""
    return unsaid or ("" if witness.stood_throughout() else "a wheel moved")
