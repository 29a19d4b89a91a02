"""The two ports between the application and a robot, real or simulated."""

from collections.abc import Mapping
from typing import Protocol

from fieldnav.faults import Trouble
from fieldnav.messages import Frame, Wheel, WheelReport, WheelSetpoint


class Camera(Protocol):
    """A camera that gives its newest frame, never a queue."""

    def latest(self, now_s: float) -> Frame | None:
        """The newest frame that has arrived by `now_s`; None before the first.

        The same object is returned until a newer frame arrives.

        Raises DriverError when the source is gone.
        """
        ...

    def close(self) -> None: ...


class Wheels(Protocol):
    """The four wheel modules."""

    @property
    def ready(self) -> bool:
        """Whether all modules are up and are the ones of the robot file."""
        ...

    @property
    def taken_over(self) -> bool:
        """Whether somebody else has commanded the wheels a moment ago; they are then left alone."""
        ...

    @property
    def stops(self) -> Trouble | None:
        """What a person must see to before the wheels may move, such as an emergency stop that is pressed."""
        ...

    def start(self, now_s: float) -> None:
        """Bring the modules to operation and command zero; nothing moves before this."""
        ...

    def poll(self, now_s: float) -> WheelReport:
        """Take in what the modules said. Raises DriverError when one has been silent too long."""
        ...

    def command(self, now_s: float, setpoints: Mapping[Wheel, WheelSetpoint]) -> None:
        """Send one set-point to each module, clipped to what the module can do."""
        ...

    def stop(self, now_s: float) -> None:
        """Command zero speed at the present steering angles; never raises, may be repeated."""
        ...

    def emergency_stop(self, now_s: float) -> None:
        """Zero, then the modules' own emergency stop. Raises DriverError when a frame did not go out."""
        ...

    def release_emergency_stop(self, now_s: float) -> None:
        """Zero, then let the modules run again; only ever on the explicit act of a person."""
        ...

    def close(self) -> None: ...
