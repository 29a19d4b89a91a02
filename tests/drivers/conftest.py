from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import can
import pytest

from drivers.can_log import open_virtual_pair
from drivers.simulated_modules import SimulatedModules
from drivers.thorvald import ThorvaldWheels
from fieldnav.messages import Wheel, WheelReport, WheelSetpoint
from fieldnav.settings.camera import Cameras, CameraSettings
from fieldnav.settings.robot import Bus, Geometry, Limits, Module, Robot

TICK_S = 0.02


@pytest.fixture
def robot() -> Robot:
    camera = CameraSettings(
        source="none",
        width_px=640,
        height_px=360,
        rate_hz=15,
        horizontal_fov_deg=69,
        height_m=1.0,
        tilt_deg=65,
        distance_m=0.75,
    )
    return Robot(
        name="test-robot",
        geometry=Geometry(track_m=1.4, wheelbase_m=1.0, length_m=1.4, clearance_m=0.86),
        modules={wheel: Module(node_id=node) for node, wheel in enumerate(Wheel, start=1)},
        cameras=Cameras(front=camera, rear=camera),
        can=Bus(interface="virtual", channel="test"),
        limits=Limits(speed_mps=1.0),
    )


@dataclass
class Bench:
    """A driver and simulated modules on one real virtual bus, on simulated time; a tap sees every frame."""

    robot: Robot
    wheels: ThorvaldWheels
    modules: SimulatedModules
    tap: can.BusABC
    far: can.BusABC
    now_s: float = 0.0
    report: WheelReport = field(default_factory=WheelReport)

    def tick(self) -> None:
        self.now_s = round(self.now_s + TICK_S, 6)
        self.modules.step(self.now_s)
        self.report = self.wheels.poll(self.now_s)

    def run(self, seconds: float, setpoint: WheelSetpoint | None = None) -> None:
        """Tick for a while; with a set-point, command it to all wheels every tick."""
        for _ in range(round(seconds / TICK_S)):
            self.tick()
            if setpoint is not None:
                self.wheels.command(self.now_s, dict.fromkeys(Wheel, setpoint))

    def start(self) -> None:
        self.wheels.start(self.now_s)
        self.run(0.1)
        assert self.wheels.ready

    def frames(self, identifier: int | None = None) -> list[can.Message]:
        """The frames on the bus since the last call, of one id or of all."""
        seen = []
        while (frame := self.tap.recv(timeout=0)) is not None:
            seen.append(frame)
        return [frame for frame in seen if identifier in (None, frame.arbitration_id)]


@pytest.fixture
def full_disk() -> Path:
    """A file that can be opened but takes no byte, as on a full disk."""
    device = Path("/dev/full")
    if not device.exists():
        pytest.skip("this system has no /dev/full")
    return device


@pytest.fixture
def bench_by(robot: Robot) -> Iterator[Callable[[Callable[[], float] | None], Bench]]:
    """Makes a bench whose driver goes by a clock, or by none."""
    buses: list[can.BusABC] = []

    def make(clock: Callable[[], float] | None) -> Bench:
        host, far = open_virtual_pair()
        tap = can.interfaces.virtual.VirtualBus(host.channel_id, preserve_timestamps=True)  # type: ignore[attr-defined]
        buses.extend((host, far, tap))
        return Bench(robot, ThorvaldWheels(robot, host, clock=clock), SimulatedModules(robot, far), tap, far)

    yield make
    for bus in buses:
        bus.shutdown()


@pytest.fixture
def bench(bench_by: Callable[[Callable[[], float] | None], Bench]) -> Bench:
    return bench_by(None)
