"""The composition root of a replay: the same mission as on a robot, on a robot of records."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from datetime import datetime
from itertools import chain, repeat

from drivers.module_link import ASKED, Missing
from drivers.thorvald import ThorvaldWheels
from fieldnav.errors import FieldnavError
from fieldnav.faults import FaultKind, Trouble
from fieldnav.journal.entry import Entry, Line, line_of
from fieldnav.journal.resolved import Settings
from fieldnav.messages import CameraName
from fieldnav.mission.loop import Mission
from fieldnav.mission.operating import Operating
from fieldnav.mission.tick import Observer
from fieldnav.operator.confirmation import Confirmations
from fieldnav.recording.records import Call, Round
from fieldnav.replay.again import ReplayedBus, ReplayedCamera
from fieldnav.replay.order import order_of
from fieldnav.replay.rounds import Taken
from states.behaviour import Task
from states.machine import Change
from states.names import Event
from states.table import LEAF_NAMED


class Lines:
    """A journal in memory."""

    def __init__(self, begun_utc: datetime) -> None:
        self._begun_utc = begun_utc
        self._sequence = 0
        self.new: list[Line] = []

    def record(self, entry: Entry) -> None:
        self.new.append(Line.model_validate(line_of(entry, self._sequence, self._begun_utc)))
        self._sequence += 1

    def taken(self) -> list[Line]:
        """The lines since the last call."""
        new, self.new = self.new, []
        return new


class ReplayedMission:
    """A mission that is done again, call by call; made anew where the run was taken up by another process."""

    def __init__(
        self,
        settings: Settings,
        begun_utc: datetime,
        observers: Iterable[Observer],
        asked: frozenset[Missing] = ASKED,
    ) -> None:
        """asked: see ModuleLink. Raises FieldnavError for settings that no mission can be made of."""
        self._settings, self._observers, self._asked = settings, tuple(observers), asked
        self._order = order_of(settings.options)
        self._lines = Lines(begun_utc)
        self._cameras = {name: ReplayedCamera(name) for name in CameraName}
        self.bus = ReplayedBus()
        self._reads_s: Iterator[float] = iter(())
        try:
            self._begin()
        except FieldnavError:
            self.close()
            raise

    def again(self, taken: Taken) -> list[Line]:
        """Do what was done in this round; the lines of the journal that come of it.

        Raises FieldnavError for what no mission can have been asked.
        """
        for camera in self._cameras.values():
            camera.begin(taken.frames, taken.round.lost)
        self.bus.begin(taken.round.wires)
        # Where the run did not look at its clock, a round took no time.
        self._reads_s = chain(taken.round.reads_s, repeat(taken.round.now_s))
        try:
            with suppress(FieldnavError):  # the mission has broken off, as its last line says
                self._do(taken.round)
        except Exception as error:
            call, said = taken.round.call.value, f"{type(error).__name__}: {error}"
            raise FieldnavError(f"{call} at {taken.round.now_s:g} s cannot be done again: {said}") from error
        return self._lines.taken()

    def bring(self, now_s: float, lines: Sequence[Line]) -> bool:
        """Go through the transitions that the run has made and this mission has not; whether it can.

        A state may need what an earlier one has seen, such as the lane.
        """
        try:
            for line in lines:
                change = Change(self.mission.course.leaf, Event(line.event), LEAF_NAMED[line.target])
                self.mission.course.brought(now_s, change)
        except (AssertionError, FieldnavError):
            return False
        return True

    def obey(self, obeyed: bool) -> None:
        """Whether the recorded wheels do what this mission tells them; a dry run's never did."""
        self.mission.commanding = obeyed and not self._order.dry_run

    def close(self) -> None:
        self.bus.shutdown()

    def _do(self, round: Round) -> None:
        now_s, operating = round.now_s, self._operating
        match round.call:
            case Call.TAKE_UP if round.booking is not None:
                self._begin()
                self._operating.take_up(round.booking)
            case Call.START:
                operating.start(now_s)
            case Call.TICK:
                operating.tick(now_s)
            case Call.PAUSE:
                operating.pause(now_s, round.by)
            case Call.RESUME:
                operating.resume(now_s, round.by)
            case Call.RESET:
                operating.reset(now_s, round.by)
            case Call.END:
                operating.end(now_s, round.by)
            case Call.BREAK_OFF:
                operating.break_off(now_s, Event.LATCH if round.latched else Event.FAIL, round.by)
            case Call.NOTE:
                operating.note(now_s, Trouble(round.fault or FaultKind.PROGRAM, round.by))

    def _begin(self) -> None:
        crop, robot, order = self._settings.crop, self._settings.robot, self._order
        pinholes = robot.cameras.pinholes()
        task = Task(crop, pinholes, order.side, order.lanes)
        wheels = ThorvaldWheels(
            robot,
            self.bus,
            listening=order.dry_run,
            asked=self._asked,
            clock=lambda: next(self._reads_s),
        )
        self.mission = Mission(
            robot,
            task,
            self._cameras,
            wheels,
            self._lines,
            self._observers,
            confirmations=Confirmations(order.asked),
            commanding=not order.dry_run,
        )
        self._operating = Operating(self.mission)
