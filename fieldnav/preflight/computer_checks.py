"""The checks of the computer: room for a run, a clock to name it by, time to think."""

from collections.abc import Iterator
from datetime import UTC, datetime

from fieldnav.preflight.computer import Computer
from fieldnav.preflight.finding import Concern, Finding, Verdict, finding_of

# An hour of can.log is 120 MB (730 frames a second of 45 characters), the journal a few MB, and an hour's
# overlay about 1.5 GB.
ROOM_BYTES, LEAST_ROOM_BYTES = 2_000_000_000, 200_000_000
MEGABYTE = 1_000_000
EARLIEST = datetime(2024, 1, 1, tzinfo=UTC)
"""Before this the software was not written: a clock without a battery."""
COARSEST_S = 0.001
"""The loop ticks twenty times slower."""
SECONDS_TO_MILLISECONDS = 1000


def computer_findings(computer: Computer) -> Iterator[Finding]:
    """Disk, clock and load."""
    yield _disk(computer)
    yield _clock(computer)
    yield _load(computer)


def _disk(computer: Computer) -> Finding:
    check = "disk"
    if computer.refusal:
        figure = f"{computer.runs} cannot be written: {computer.refusal}"
        return Finding(check, Verdict.FAIL, figure, "name a folder you can write with --out")
    figure = f"{computer.free_bytes / MEGABYTE:.0f} MB free for {computer.runs}"
    if computer.free_bytes >= ROOM_BYTES:
        return Finding(check, Verdict.OK, figure)
    verdict = Verdict.FAIL if computer.free_bytes < LEAST_ROOM_BYTES else Verdict.WARNING
    limits = f"{LEAST_ROOM_BYTES / MEGABYTE:.0f} MB is the least, {ROOM_BYTES / MEGABYTE:.0f} MB is well"
    return Finding(check, verdict, f"{figure}; {limits}", "make room, or name another disk with --out")


def _clock(computer: Computer) -> Finding:
    """Nothing goes by the wall clock, but runs are named by it; the loop goes by the monotonic one."""
    concerns = []
    if computer.tick_s > COARSEST_S:
        words = f"the monotonic clock ticks every {computer.tick_s * SECONDS_TO_MILLISECONDS:g} ms"
        concerns.append(Concern(Verdict.FAIL, words, "use another clock source of the system"))
    earliest = max(EARLIEST, computer.installed)
    if computer.utc < earliest:
        words = f"{computer.utc:%Y-%m-%d %H:%M} UTC is before {earliest:%Y-%m-%d %H:%M}"
        concerns.append(Concern(Verdict.WARNING, words, "set the clock: runs are named by it"))
    if computer.synchronised is False:
        words = f"{computer.utc:%Y-%m-%d %H:%M} UTC, not synchronised"
        concerns.append(Concern(Verdict.WARNING, words, "compare it with your watch: runs are named by it"))
    return finding_of("clock", f"{computer.utc:%Y-%m-%d %H:%M} UTC", concerns)


def _load(computer: Computer) -> Finding:
    figure = f"{computer.load:.1f} of {computer.processors} processors busy"
    if computer.load <= computer.processors:
        return Finding("computer", Verdict.OK, figure)
    return Finding("computer", Verdict.WARNING, figure, "find what else runs: the loop would be late")
