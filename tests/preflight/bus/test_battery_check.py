"""The battery's line."""

import pytest

from drivers.simulated_battery import BASE_CURRENT_A, CAPACITY_AS
from drivers.thorvald_protocol import Kind
from fieldnav.preflight.battery_check import battery
from fieldnav.preflight.finding import Verdict


def test_the_battery_tells_voltage_charge_and_health(bench):
    found = bench.check()

    assert found["battery"].verdict is Verdict.OK
    assert found["battery"].figure == "53.8 V, charge 100 %, health 98 %"


@pytest.mark.parametrize(
    ("charge", "verdict"), [(0.20, Verdict.OK), (0.19, Verdict.WARNING), (0.09, Verdict.FAIL)]
)
def test_a_battery_near_its_least_charge_is_warned_of_and_below_it_fails(bench, charge, verdict):
    bench.modules.battery.advance(dt_s=(1 - charge) * CAPACITY_AS, modules_a=1 - BASE_CURRENT_A)

    found = bench.check()

    assert found["battery"].verdict is verdict
    assert f"charge {charge:.0%}".replace("%", " %") in found["battery"].figure


def test_a_battery_that_says_nothing_or_tells_an_alarm_is_warned_of(bench):
    alarmed = {Kind.BATTERY_VOLTAGE: {"Voltage": 51.2, "Alarms": 0x2}}
    full = {Kind.BATTERY_CHARGE: {"StateOfCharge": 90, "StateOfHealth": 95}}

    nothing = battery({}, bench.robot.battery)
    alarm = battery(alarmed | full, bench.robot.battery)

    assert nothing.verdict is Verdict.WARNING and "tells no charge" in nothing.figure
    assert alarm.verdict is Verdict.WARNING and "alarms 0002" in alarm.figure
