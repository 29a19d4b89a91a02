"""The check of the battery, by its own telegrams."""

from collections.abc import Mapping

from drivers.thorvald_protocol import Kind
from fieldnav.preflight.finding import Concern, Finding, Verdict, finding_of
from fieldnav.settings.robot import Battery

CHECK = "battery"
AMPLE = 2
"""Times the least charge: what is above it is called well; our choice."""
CHARGE_IT = "charge it"


def battery(told: Mapping[Kind, Mapping[str, float]], limits: Battery) -> Finding:
    """Voltage, charge and health as the battery told them, by telegram."""
    charge, voltage = told.get(Kind.BATTERY_CHARGE), told.get(Kind.BATTERY_VOLTAGE)
    if charge is None:
        return Finding(CHECK, Verdict.WARNING, "tells no charge (3E1)", "see to its plug; measure it by hand")
    percent = charge["StateOfCharge"]
    volts = f"{voltage['Voltage']:.1f} V, " if voltage else ""
    figure = f"{volts}charge {percent:.0f} %, health {charge['StateOfHealth']:.0f} %"
    concerns = []
    if percent < AMPLE * limits.least_charge:
        verdict = Verdict.FAIL if percent < limits.least_charge else Verdict.WARNING
        words = f"{figure}; the robot stops below {limits.least_charge:g} %"
        concerns.append(Concern(verdict, words, CHARGE_IT))
    if voltage and voltage["Alarms"]:
        words = f"alarms {int(voltage['Alarms']):04X}"
        concerns.append(Concern(Verdict.WARNING, words, "look them up in the battery's manual"))
    return finding_of(CHECK, figure, concerns)
