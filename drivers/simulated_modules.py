"""The far end of the bus: four simulated wheel modules and the battery, all behind one bus object.

Time comes in with `step` and passes in ticks of TICK_MS, so the same frames at the same times give the same
answers bit for bit, however often `step` is called in between.
"""

from collections import deque
from collections.abc import Mapping

import can

from drivers.simulated_battery import SimulatedBattery
from drivers.simulated_module import SimulatedModule
from drivers.simulated_motion import ModuleErrors
from drivers.simulated_voice import Voice
from drivers.thorvald_protocol import Kind
from drivers.wire_layout import NO_NODE, Telegram, wire_layout
from fieldnav.messages import Wheel, WheelSetpoint
from fieldnav.settings.robot import Robot

TICK_MS = 5
MILLISECONDS_PER_SECOND = 1000
TICK_S = TICK_MS / MILLISECONDS_PER_SECOND

NMT_TO_ALL = 0
"""Node number of an NMT command that every node obeys (CiA 301)."""

TOLERANCE_S = 1e-6
"""Two times nearer than this are the same; far above the rounding of any sum of ticks."""

FAULTLESS = ModuleErrors()


class SimulatedModules:
    """All modules of a robot on `bus`; a frame is acted on `can_delay_s` after its stamp."""

    def __init__(
        self,
        robot: Robot,
        bus: can.BusABC,
        errors: Mapping[Wheel, ModuleErrors] | None = None,
        can_delay_s: float = 0.0,
    ) -> None:
        self._layout = wire_layout()
        self._bus = bus
        self._delay_s = can_delay_s
        self._waiting: deque[tuple[float, Telegram]] = deque()
        self._tick: int | None = None
        self.battery = SimulatedBattery()
        errors = errors or {}
        self.modules = {
            wheel: SimulatedModule(robot.modules[wheel], errors.get(wheel, FAULTLESS)) for wheel in Wheel
        }
        self._voices = [(module, Voice(module)) for module in self.modules.values()]

    def step(self, now_s: float) -> None:
        """Take in what was sent, and let all ticks up to `now_s` pass."""
        last = int((now_s + TOLERANCE_S) * MILLISECONDS_PER_SECOND) // TICK_MS
        if self._tick is None:
            self._tick = last - 1
        while (frame := self._bus.recv(timeout=0)) is not None:
            telegram = self._layout.read(frame)
            if telegram is not None:
                self._waiting.append((frame.timestamp + self._delay_s, telegram))
        while self._tick < last:
            self._tick += 1
            self._pass_tick(self._tick)

    def wheel_states(self) -> Mapping[Wheel, WheelSetpoint]:
        """The wheels' true rim speeds and angles."""
        return {wheel: module.truth for wheel, module in self.modules.items()}

    def _pass_tick(self, tick: int) -> None:
        now_ms = tick * TICK_MS
        now_s = now_ms / MILLISECONDS_PER_SECOND
        for module in self.modules.values():
            module.advance(now_s, TICK_S)
        self.battery.advance(TICK_S, sum(module.motion.battery_current_a for module in self.modules.values()))
        while self._waiting and self._waiting[0][0] <= now_s + TOLERANCE_S:
            self._deliver(now_s, self._waiting.popleft()[1])
        battery_v = self.battery.voltage_v
        for module, voice in self._voices:
            for kind, values in voice.speak(now_ms, battery_v):
                self._say(now_s, module, kind, values)
        for kind, values in self.battery.speak(now_ms):
            self._bus.send(self._layout.frame(now_s, NO_NODE, kind, values))

    def _deliver(self, now_s: float, telegram: Telegram) -> None:
        node = int(telegram.values["Node"]) if telegram.kind is Kind.NMT else telegram.node
        to_all = telegram.kind is Kind.NMT and node == NMT_TO_ALL
        for module in self.modules.values():
            if to_all or node == module.module.node_id:
                answer = module.obey(now_s, telegram.kind, telegram.values)
                if answer is not None and Kind.SDO_REPLY not in module.muted:
                    self._say(now_s, module, Kind.SDO_REPLY, answer)

    def _say(self, now_s: float, module: SimulatedModule, kind: Kind, values: Mapping[str, float]) -> None:
        if not module.silent:
            self._bus.send(self._layout.frame(now_s, module.module.node_id, kind, values))
