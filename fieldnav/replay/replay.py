"""The recorded frames and telemetry of a run through today's perception, states and CAN encoding."""

from collections.abc import Callable, Sequence
from contextlib import closing

import cv2

from fieldnav.errors import FieldnavError
from fieldnav.faults import FaultKind
from fieldnav.inquiry.moment import clock
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.entry import Line
from fieldnav.journal.journal import read
from fieldnav.journal.resolved import Settings
from fieldnav.mission.chronicle import OBSERVER_LOST
from fieldnav.recording.recording import Recording
from fieldnav.replay.commands import CommandWatch
from fieldnav.replay.completeness import Completeness
from fieldnav.replay.difference import Difference, Kind, Replayed, judged_otherwise
from fieldnav.replay.following import Following
from fieldnav.replay.mission import ReplayedMission
from fieldnav.replay.picture_size import check_pictures
from fieldnav.replay.rounds import Taken, questions, taken
from states.names import Event
from states.table import LEAF_NAMED

EVENTS = {event.value for event in Event}
Tell = Callable[[float, float], None]
"""Told the second of the run that is replayed, and its last."""


def replay(
    directory: RunDirectory, then: Settings, now: Settings | None = None, tell: Tell | None = None
) -> Replayed:
    """Replay a run; `now`: other settings than it was driven with. Raises FieldnavError."""
    if now is not None:
        check_pictures(then, now)
    lines = read(directory.journal)
    if not lines:
        raise FieldnavError(f"{directory.journal}: holds no line; there is nothing to replay")
    recording = Recording.open(directory)
    if recording is None:
        raise FieldnavError(f"{directory.recording}: is not there; allowed is a run that was recorded")
    cv2.setNumThreads(1)
    with recording:
        recording.check()  # a flipped byte need not show in anything that is compared
        with closing(_Replay(directory, recording, lines, then, now or then)) as going:
            return going.run(tell)


class _Replay:
    """One replay as it goes."""

    def __init__(
        self,
        directory: RunDirectory,
        recording: Recording,
        lines: Sequence[Line],
        then: Settings,
        now: Settings,
    ) -> None:
        self._name, self._recording = directory.path.absolute().name, recording
        self._lines = {line.seq: line for line in lines}
        self._changed = now != then
        self._following, self._notes = Following(), list[Difference]()
        self._watch = CommandWatch(recording.ticks())
        self._mission = ReplayedMission(now, lines[0].utc, [self._watch], questions(recording))
        self._rounds, self._complete = 0, Completeness(self._lines)
        self._brought, self._astray = False, ""

    def run(self, tell: Tell | None) -> Replayed:
        now_s = 0.0
        for each in taken(self._recording):
            now_s = each.round.now_s
            self._round(each)
            if self._astray:
                break
            if tell is not None:
                tell(now_s, self._recording.end_s)
        self._following.end()
        return self._outcome(now_s)

    def close(self) -> None:
        self._mission.close()

    def _round(self, each: Taken) -> None:
        now_s = each.round.now_s
        self._rounds += 1
        self._complete.take(each)
        self._mission.obey(self._watch.obeyed(now_s))
        now = self._mission.again(each)
        then = [self._lines[seq] for seq in each.round.lines if seq in self._lines]
        if self._brought and any(_broke(line) for line in now):
            self._lose(now_s)
            return
        self._watch.sent(now_s, self._mission.bus.alike)
        self._compare_notes(_notes(then), _notes(now))
        self._following.take(_changes(then), _changes(now))
        if behind := self._following.behind:
            lacked = {line.event: self._watch.lacked(line.event) for line in behind}
            self._brought = True
            if not self._mission.bring(now_s, behind):
                self._lose(now_s)
            self._following.brought(lacked)

    def _lose(self, now_s: float) -> None:
        """It was brought to where a state needs what an earlier one has seen, such as the lane."""
        self._astray = f"from {clock(now_s)} on the replay knows too little to be where the run was"

    def _compare_notes(self, then: list[Line], now: list[Line]) -> None:
        """Notes change no state: they are the same in the same round, or one of them is alone."""
        for before, after in zip(then, now, strict=False):
            if said := judged_otherwise(before, after):
                self._notes.append(Difference(kind=Kind.NOTED, then=before, now=after, said=said))
        rest_then, rest_now = then[len(now) :], now[len(then) :]
        self._notes += [Difference(kind=Kind.MISSING, then=line) for line in rest_then]
        self._notes += [Difference(kind=Kind.ADDED, now=line) for line in rest_now]

    def _outcome(self, end_s: float) -> Replayed:
        found = [*self._following.differences]
        if not self._changed:  # other settings are other thresholds, and so judged otherwise everywhere
            found += [*self._following.judged, *self._notes]
        absent = [f"{name} is not there" for name in self._recording.lacking]
        astray = [self._astray] if self._astray else []
        incomplete = [*absent, *astray, *self._complete.said(to_the_end=not astray)]
        return Replayed(
            run=self._name,
            changed=self._changed,
            rounds=self._rounds,
            seconds=end_s,
            transitions=self._following.transitions,
            differences=tuple(sorted(found, key=lambda each: each.line.stamp_s)),
            commands=self._watch.commands,
            incomplete=tuple(incomplete),
        )


def _broke(line: Line) -> bool:
    """Whether an error in the program broke the mission off."""
    return line.event == Event.LATCH.value and line.reason.startswith(FaultKind.PROGRAM.value)


def _changes(lines: Sequence[Line]) -> list[Line]:
    """The lines that are transitions."""
    return [line for line in lines if line.event in EVENTS and line.target in LEAF_NAMED]


def _notes(lines: Sequence[Line]) -> list[Line]:
    """The others, but for what is said of those who only looked on."""
    return [line for line in lines if line.event not in EVENTS and line.event != OBSERVER_LOST]
