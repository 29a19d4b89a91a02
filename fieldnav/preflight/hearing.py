"""All that was heard on the bus, sorted: the modules' words, the battery's, others' commands, errors."""

from collections.abc import Callable, Mapping

import can

from drivers.module_link import ModuleLink
from drivers.own_frames import OwnFrames
from drivers.plausibility import plausible
from drivers.reopened_bus import BUS_ERRORS, said
from drivers.thorvald_protocol import Kind
from drivers.wire_layout import Telegram, wire_layout
from fieldnav.messages import Wheel
from fieldnav.settings.robot import Robot

BATTERY = frozenset({Kind.BATTERY_VOLTAGE, Kind.BATTERY_CURRENT, Kind.BATTERY_CHARGE})
HOSTS_OWN = frozenset(
    {Kind.NMT, Kind.DRIVE, Kind.SET_UP, Kind.MODE, Kind.STEER, Kind.SDO_REQUEST, Kind.HOST_HEARTBEAT}
)
"""What only a host says; this host's own words are not among what is heard."""
HEAD_BITS, LONG_HEAD_BITS = 47, 67
"""Of a frame beside its data, with the gap after it: 11 bit identifier, 29 bit one (ISO 11898)."""
BITS_PER_BYTE = 8
STUFFED = 1.1
"""With the bits that are stuffed in: at most a quarter, usually about a tenth."""


class Hearing:
    """What was heard; modules' words also as their links on the host's side keep them."""

    def __init__(self, robot: Robot) -> None:
        self.links = {wheel: ModuleLink(wheel, robot.modules[wheel]) for wheel in Wheel}
        self._by_node = {link.module.node_id: link for link in self.links.values()}
        self._layout = wire_layout()
        self.kinds: dict[Wheel, set[Kind]] = {wheel: set() for wheel in Wheel}
        self.garbled = dict.fromkeys(Wheel, 0)
        self.battery: dict[Kind, Mapping[str, float]] = {}
        self.foreign: dict[int, Telegram] = {}
        self.errors: list[can.Message] = []
        self.failure = ""
        self.started = False
        self.began_s = self.ended_s = 0.0
        self.frames, self.bits = 0, 0.0

    def begin(self, now_s: float) -> None:
        """Count frames from now on."""
        self.began_s = self.ended_s = now_s
        self.frames, self.bits = 0, 0.0

    @property
    def counted_s(self) -> float:
        """How long frames have been counted for."""
        return self.ended_s - self.began_s

    def told(self, wheel: Wheel) -> bool:
        """Whether the module has said all that is asked of it."""
        link = self.links[wheel]
        return link.missing is None and link.version is not None

    @property
    def complete(self) -> bool:
        """Whether nothing more is to be waited for."""
        charged = Kind.BATTERY_CHARGE in self.battery and Kind.BATTERY_VOLTAGE in self.battery
        return charged and all(map(self.told, Wheel))

    def take(self, frame: can.Message, now_s: float) -> None:
        """Sort in a frame that was received."""
        if frame.is_error_frame:
            self.errors.append(frame)
            return
        self.frames += 1
        head = LONG_HEAD_BITS if frame.is_extended_id else HEAD_BITS
        self.bits += STUFFED * (head + BITS_PER_BYTE * len(frame.data))
        telegram = self._layout.heard(frame)
        if telegram is None:
            return
        if telegram.kind in HOSTS_OWN:
            self.foreign.setdefault(frame.arbitration_id, telegram)
        elif telegram.kind in BATTERY and telegram.values:
            self.battery[telegram.kind] = telegram.values
        elif link := self._by_node.get(telegram.node):
            self._take_of_module(link, telegram, now_s)

    def _take_of_module(self, link: ModuleLink, telegram: Telegram, now_s: float) -> None:
        if plausible(telegram, link.module):
            self.kinds[link.wheel].add(telegram.kind)
        else:
            self.garbled[link.wheel] += 1
        link.take(telegram, now_s)


class Ear(can.BusABC):
    """A bus that lets a hearing take whatever is received; leaves the bus below open."""

    def __init__(self, bus: can.BusABC, hearing: Hearing, clock: Callable[[], float]) -> None:
        super().__init__(channel=bus.channel_info)
        self.channel_info = f"{bus.channel_info}, listened to"
        self._bus, self._hearing, self._clock = bus, hearing, clock
        self._own = OwnFrames()

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        try:
            self._own.send(self._bus, msg, timeout)
        except BUS_ERRORS as error:
            self._hearing.failure = f"cannot be written: {said(error)}"
            raise

    def recv(self, timeout: float | None = None) -> can.Message | None:
        try:
            frame = self._own.next_of_others(self._bus, timeout)
        except BUS_ERRORS as error:
            self._hearing.failure = f"cannot be read: {said(error)}"
            raise
        if frame is not None:
            self._hearing.take(frame, self._clock())
        return frame
