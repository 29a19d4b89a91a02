"""The checks of the bus: traffic and load, errors, and whether anybody else commands."""

from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

import can

from drivers.bus_watch import BUS_OFF_BIT, FULLEST
from drivers.reopened_bus import BUS_ERRORS
from fieldnav.preflight.finding import Concern, Finding, Verdict, finding_of
from fieldnav.preflight.foreign_words import meaning
from fieldnav.preflight.hearing import Hearing
from fieldnav.settings.robot import Bus

BUSY = 0.4
"""Share of the bit rate; four modules and a battery take 8 % of 500 kbit/s, 32 % of 125. Our choice."""
COUNTERS = ("rx_errors", "tx_errors", "rx_dropped", "tx_dropped", "rx_over_errors")
"""What Linux counts of a network interface, a CAN controller among them, since it was set up."""
NETWORK = Path("/sys/class/net")
SEE_TO_BUS = "see to cable, termination and can.bitrate"


def traffic(hearing: Hearing, settings: Bus) -> Finding:
    """How much is heard."""
    check = "bus frames"
    if hearing.failure:
        return Finding(check, Verdict.FAIL, hearing.failure, SEE_TO_BUS)
    if hearing.frames == 0:
        figure = f"none within {hearing.counted_s:.1f} s"
        return Finding(check, Verdict.FAIL, figure, f"see to the modules' power; {SEE_TO_BUS}")
    load = hearing.bits / hearing.counted_s / settings.bitrate
    figure = f"{hearing.frames / hearing.counted_s:.0f} a second, load {load:.1%}"
    if load <= BUSY:
        return Finding(check, Verdict.OK, figure)
    verdict = Verdict.FAIL if load > FULLEST else Verdict.WARNING
    return Finding(check, verdict, f"{figure}, {BUSY:.0%} or less is well", "find who else sends")


def errors(
    hearing: Hearing, state: can.BusState | None, before: Mapping[str, int], after: Mapping[str, int]
) -> Finding:
    """Error frames, the controller's state, and the kernel's counters before and after listening."""
    concerns = []
    off = any(frame.arbitration_id & BUS_OFF_BIT for frame in hearing.errors)
    if off or state is can.BusState.ERROR:
        concerns.append(Concern(Verdict.FAIL, "the controller is bus-off", SEE_TO_BUS))
    if state is can.BusState.PASSIVE:
        concerns.append(Concern(Verdict.WARNING, "the controller is error-passive", SEE_TO_BUS))
    if hearing.errors:
        concerns.append(Concern(Verdict.WARNING, f"{len(hearing.errors)} error frames", SEE_TO_BUS))
    grown = [f"{name} +{after[name] - before[name]}" for name in before if after.get(name, 0) > before[name]]
    if grown:
        concerns.append(Concern(Verdict.WARNING, f"counters grow: {', '.join(grown)}", SEE_TO_BUS))
    counted = ", ".join(f"{name} {count}" for name, count in after.items())
    return finding_of("bus errors", f"no error frame{'; ' if counted else ''}{counted}", concerns)


def other_hosts(hearing: Hearing) -> Finding:
    """Whether another host speaks on the bus."""
    check = "other hosts"
    if not hearing.foreign:
        return Finding(check, Verdict.OK, "none heard, before the modules were brought up or since")
    heard = "; ".join(f"{identifier:03X} {meaning(told)}" for identifier, told in hearing.foreign.items())
    return Finding(check, Verdict.FAIL, heard, "switch the remote or the other computer off")


def state_of(bus: can.BusABC) -> can.BusState | None:
    """The controller's state; None where the interface does not tell."""
    try:
        return bus.state
    except (*BUS_ERRORS, NotImplementedError):
        return None


def counters(folder: Path) -> dict[str, int]:
    """The kernel's counters in a network interface's `statistics`; empty where there are none."""
    counted = {}
    for name in COUNTERS:
        with suppress(OSError, ValueError):
            counted[name] = int((folder / name).read_text(encoding="ascii"))
    return counted
