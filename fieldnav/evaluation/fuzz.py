"""`bench fuzz`: a million bad CAN frames and ten thousand broken files; no crash, no motion, clear errors."""

from dataclasses import dataclass, replace
from pathlib import Path

from fieldnav.errors import SettingsError
from fieldnav.evaluation.benchmark import Failure, Progress, Report
from fieldnav.evaluation.campaign import Failed, run_campaign
from fieldnav.evaluation.fuzz_can import Bout, Fought, Part, Prepare, fight
from fieldnav.evaluation.fuzz_files import FILES, Batch, ReadBatch, batches, read_batch
from fieldnav.evaluation.fuzz_lane import tracking_mission
from fieldnav.evaluation.fuzz_modules import unstarted_modules
from fieldnav.evaluation.fuzz_report import report
from fieldnav.evaluation.fuzz_targets import standing_driver, standing_mission

ALL_FRAMES, ALL_FILES = 1_000_000, 10_000
QUICK_FRAMES, QUICK_FILES = 30_000, 300
BOUT_FRAMES, TRACKING_FRAMES, BATCH_FILES = 10_000, 20_000, 200
FRAMES_PER_LANE = 15_000
"""One lane is driven among bad frames for so many frames of the whole: a drive costs as much as they do."""
PREPARE: dict[Part, Prepare] = {
    Part.DRIVER: standing_driver,
    Part.MISSION: standing_mission,
    Part.MODULES: unstarted_modules,
    Part.TRACKING: tracking_mission,
}


@dataclass(frozen=True, slots=True)
class FuzzPlan:
    """How much is thrown, where it begins, and the folder that broken files are kept in."""

    frames: int = ALL_FRAMES
    files: int = ALL_FILES
    seed: int = 1
    jobs: int = 1
    kept: Path | None = None


def in_short(plan: FuzzPlan) -> FuzzPlan:
    """The same in under a minute."""
    return replace(plan, frames=QUICK_FRAMES, files=QUICK_FILES)


def fuzz(plan: FuzzPlan, progress: Progress) -> Report:
    """Everything. A lane ends where a frame stops the mission, so lanes go first and the rest fills up."""
    lanes = [
        Bout(Part.TRACKING, index, TRACKING_FRAMES, plan.seed)
        for index in range(-(-plan.frames // FRAMES_PER_LANE))
    ]
    driven = run_campaign("lanes among bad frames", throw, lanes, plan.jobs, progress)
    fought = [_fought(each) for each in driven]
    bouts = bouts_of(plan.frames - sum(each.frames for each in fought), plan.seed)
    stood = run_campaign("bouts of bad frames", throw, bouts, plan.jobs, progress)
    of_files = batches(plan.files, plan.seed, plan.kept, BATCH_FILES)
    read = run_campaign("batches of broken files", read_batch, of_files, plan.jobs, progress)
    return report([*fought, *(_fought(each) for each in stood)], [_read(each) for each in read])


def once_more(case: str, plan: FuzzPlan, progress: Progress) -> Report:
    """One bout or one file of a plan again. Raises SettingsError for a case that there is not."""
    word, _, number = case.partition(":")
    known = [part.value for part in Part] + [FILES]
    if word not in known or not number.isdecimal():
        allowed = f"one of {', '.join(known)}, a colon, and a number"
        raise SettingsError(f"--again: '{case}' is not allowed; allowed is {allowed}, as a failure names it")
    if word == FILES:
        first = int(number)
        return report([], [read_batch(Batch(first, first + 1, plan.seed, plan.kept))])
    part = Part(word)
    frames = TRACKING_FRAMES if part is Part.TRACKING else BOUT_FRAMES
    return report([throw(Bout(part, int(number), frames, plan.seed))], [])


def throw(bout: Bout) -> Fought:
    """One bout, against what its part names."""
    return fight(bout, PREPARE[bout.part])


def bouts_of(frames: int, seed: int) -> list[Bout]:
    """So many frames at least against each standing part in turn, the last bout as long as all others."""
    standing = (Part.DRIVER, Part.MISSION, Part.MODULES)
    count = -(-max(frames, 0) // BOUT_FRAMES)
    return [
        Bout(standing[each % len(standing)], each // len(standing), BOUT_FRAMES, seed)
        for each in range(count)
    ]


def _fought(outcome: Fought | Failed[Bout]) -> Fought:
    """A process that died is the worst of crashes."""
    if isinstance(outcome, Fought):
        return outcome
    bout = outcome.job
    return Fought(bout, 0, crash=Failure(bout.title, outcome.reason, bout.again))


def _read(outcome: ReadBatch | Failed[Batch]) -> ReadBatch:
    if isinstance(outcome, ReadBatch):
        return outcome
    batch = outcome.job
    again = f"fieldnav bench fuzz --seed {batch.seed} --again {FILES}:{batch.first}"
    case = f"{FILES}:{batch.first} to {batch.last - 1}"
    return ReadBatch(batch.last - batch.first, 0, 0.0, (Failure(case, outcome.reason, again),))
