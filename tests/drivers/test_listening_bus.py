"""A bus on which nothing is said."""

import can

from drivers.can_log import open_virtual_pair
from drivers.listening_bus import ListeningBus


def test_what_is_sent_goes_nowhere_and_what_is_said_is_heard() -> None:
    host, far = open_virtual_pair()
    bus = ListeningBus(host)

    bus.send(can.Message(arbitration_id=0x201, data=bytes(8), is_extended_id=False))
    far.send(can.Message(arbitration_id=0x181, data=bytes(8), is_extended_id=False))
    heard = bus.recv(timeout=1)

    assert far.recv(timeout=0) is None
    assert heard is not None and heard.arbitration_id == 0x181
    bus.shutdown()
    far.shutdown()
