"""What a replay did otherwise than the run that was recorded."""

from enum import Enum

from pydantic import BaseModel, ConfigDict

from fieldnav.journal.entry import Judged, Line


class Kind(Enum):
    """How a transition differs."""

    MOVED = "moved"
    MISSING = "missing"
    ADDED = "added"
    JUDGED = "judged otherwise"
    NOTED = "noted otherwise"


class Difference(BaseModel):
    """One transition or note of then, of now, or of both."""

    model_config = ConfigDict(frozen=True)

    kind: Kind
    then: Line | None = None
    now: Line | None = None
    said: str = ""

    @property
    def line(self) -> Line:
        """The line that it is about: of then, where there is one."""
        line = self.then or self.now
        assert line is not None, "a difference is about something"
        return line

    @property
    def later_s(self) -> float | None:
        """How much later it came now."""
        return self.now.stamp_s - self.then.stamp_s if self.then and self.now else None

    @property
    def later_m(self) -> float | None:
        """How much further the robot had driven, along or across, when it came now."""
        if self.then is None or self.now is None:
            return None
        before, after = _place(self.then), _place(self.now)
        if before is None or after is None:
            return None
        apart_m = max(abs(after[0] - before[0]), abs(after[1] - before[1]))
        return apart_m if self.now.stamp_s >= self.then.stamp_s else -apart_m


class Commands(BaseModel):
    """How what was sent to the wheels differs: in how many rounds, from when on, at most by how much."""

    model_config = ConfigDict(frozen=True)

    rounds: int = 0
    first_s: float | None = None
    vx_mps: float = 0.0
    vy_mps: float = 0.0
    yaw_rate_rps: float = 0.0


class Replayed(BaseModel):
    """The outcome of a replay; `changed`: it ran with other settings than the run.

    incomplete: why less than the whole run could be compared, one sentence each.
    """

    model_config = ConfigDict(frozen=True)

    run: str
    changed: bool
    rounds: int
    seconds: float
    transitions: int
    differences: tuple[Difference, ...]
    commands: Commands
    incomplete: tuple[str, ...] = ()

    @property
    def same(self) -> bool:
        """Whether everything was the same, bit for bit."""
        return not (self.differences or self.commands.rounds or self.incomplete)


def judged_otherwise(then: Line, now: Line) -> str:
    """What two lines of one transition judge or say differently, in words; empty where nothing."""
    before, after = ({each.name: each for each in line.evidence} for line in (then, now))
    parts = [
        _changed(name, before.get(name), after.get(name))
        for name in dict.fromkeys([*before, *after])
        if before.get(name) != after.get(name)
    ]
    if then.reason != now.reason:
        parts.append(f"'{then.reason}' -> '{now.reason}'")
    if not parts and then.model_dump(exclude={"seq", "utc"}) != now.model_dump(exclude={"seq", "utc"}):
        parts.append("command, frame or place")
    return "; ".join(parts)


def _changed(name: str, before: Judged | None, after: Judged | None) -> str:
    """Its value, or, where that reads the same, what else of it has changed."""
    if _value(before) != _value(after) or before is None or after is None:
        return f"{name} {_value(before)} -> {_value(after)}"
    old, new = before.model_dump(mode="json"), after.model_dump(mode="json")
    return "; ".join(f"{name}: {key} {old[key]} -> {new[key]}" for key in old if old[key] != new[key])


def _value(each: Judged | None) -> str:
    if each is None:
        return "not judged"
    limit = "" if each.threshold is None else f" (of {each.threshold:.6g})"
    return ("unknown" if each.value is None else f"{each.value:.6g}") + limit


def _place(line: Line) -> tuple[float, float] | None:
    """What the wheels had travelled ahead and to the left."""
    if line.forward_m is None or line.sideways_m is None:
        return None
    return line.forward_m, line.sideways_m
