"""What a fuzz comes to: frames and files, and how many of them broke something."""

from collections.abc import Sequence

from fieldnav.evaluation.benchmark import Better, Figure, Report
from fieldnav.evaluation.fuzz_can import Fought, Part
from fieldnav.evaluation.fuzz_files import FILES, SLOWEST_S, ReadBatch

CASES = {
    Part.DRIVER: "a driver that stands",
    Part.MISSION: "a mission that stands",
    Part.MODULES: "modules not started",
    Part.TRACKING: "a mission that drives",
}
ALL = "all frames"


def report(fought: Sequence[Fought], read: Sequence[ReadBatch]) -> Report:
    """Figures of each part that was played, of all frames, and of the files; then what went wrong."""
    parts = {name: [each for each in fought if each.bout.part is part] for part, name in CASES.items()}
    parts |= {ALL: list(fought)}
    figures = [figure for name, bouts in parts.items() if bouts for figure in _of_frames(name, bouts)]
    wrong = [failure for each in fought for failure in (each.crash, each.motion) if failure is not None]
    of_files = [failure for each in read for failure in each.failures]
    return Report((*figures, *_of_files(read)), failures=(*wrong, *of_files))


def _of_frames(case: str, bouts: Sequence[Fought]) -> list[Figure]:
    crashes = sum(each.crash is not None for each in bouts)
    motions = sum(each.motion is not None for each in bouts)
    return [
        Figure(case, "frames thrown", float(sum(each.frames for each in bouts))),
        _none(case, "crashes", crashes),
        _none(case, "motions that should not be", motions),
    ]


def _of_files(read: Sequence[ReadBatch]) -> list[Figure]:
    if not read:
        return []
    slowest_s = max(each.slowest_s for each in read)
    return [
        Figure(FILES, "files", float(sum(each.files for each in read))),
        Figure(FILES, "still valid", float(sum(each.accepted for each in read))),
        _none(FILES, "unclear errors and worse", sum(len(each.failures) for each in read)),
        Figure(FILES, "slowest (s)", slowest_s, goal=SLOWEST_S, better=Better.LOWER),
    ]


def _none(case: str, metric: str, count: int) -> Figure:
    return Figure(case, metric, float(count), goal=0.0, better=Better.LOWER)
