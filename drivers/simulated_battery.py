"""The simulated robot's battery: it sags under load and empties slowly."""

from collections.abc import Mapping

from drivers.thorvald_protocol import Kind

FULL_V, EMPTY_V = 54.0, 44.0
"""Open voltage full and empty; our choice, for a 48 V lithium battery."""

RESISTANCE_OHM = 0.03
CAPACITY_AS = 70.0 * 3600
"""Charge of 70 Ah; our choice."""

BASE_CURRENT_A = 4.0
"""The computer, the cameras and the lights; our choice."""

TEMPERATURE_C = 22
HEALTH_PERCENT = 98
CYCLE_MS = 1000
PERCENT = 100


class SimulatedBattery:
    """Battery number 1 on the bus."""

    def __init__(self) -> None:
        self.current_a = BASE_CURRENT_A
        self._taken_as = 0.0
        self._next_ms: int | None = None

    @property
    def charge(self) -> float:
        """State of charge, 0 to 1."""
        return max(0.0, 1 - self._taken_as / CAPACITY_AS)

    @property
    def voltage_v(self) -> float:
        return EMPTY_V + (FULL_V - EMPTY_V) * self.charge - RESISTANCE_OHM * self.current_a

    def advance(self, dt_s: float, modules_a: float) -> None:
        """Give the modules their current for `dt_s`."""
        self.current_a = BASE_CURRENT_A + modules_a
        self._taken_as += self.current_a * dt_s

    def speak(self, now_ms: int) -> list[tuple[Kind, Mapping[str, float]]]:
        """The three telegrams, once a second."""
        if self._next_ms is not None and now_ms < self._next_ms:
            return []
        self._next_ms = now_ms + CYCLE_MS
        temperatures = {"LowestTemperature": TEMPERATURE_C, "HighestTemperature": TEMPERATURE_C}
        return [
            (Kind.BATTERY_VOLTAGE, {"Voltage": self.voltage_v, "Alarms": 0}),
            (Kind.BATTERY_CURRENT, {"Current": -self.current_a, **temperatures}),
            (
                Kind.BATTERY_CHARGE,
                {"StateOfCharge": round(PERCENT * self.charge), "StateOfHealth": HEALTH_PERCENT},
            ),
        ]
