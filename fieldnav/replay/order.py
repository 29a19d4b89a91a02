"""What a run was told to do, from the options that its settings keep."""

from collections.abc import Mapping

from pydantic import Field

from fieldnav.errors import SettingsError
from fieldnav.journal.resolved import Option
from fieldnav.messages import Side
from fieldnav.settings.loading import checked
from fieldnav.settings.model import Settings
from states.names import Event

BETWEEN = ", "


class Order(Settings):
    """The options that decide what a mission does; confirm: events that a person was to say yes to."""

    lanes: int = Field(ge=1)
    side: Side
    dry_run: bool = False
    confirm: str = ""

    @property
    def asked(self) -> frozenset[Event]:
        return frozenset(Event(each) for each in self.confirm.split(BETWEEN) if each)


def order_of(options: Mapping[str, Option]) -> Order:
    """The order that options hold, others passed over. Raises SettingsError."""
    label = "settings.yaml: options"
    order = checked(Order, {key: options[key] for key in Order.model_fields if key in options}, label)
    events = [event.value for event in Event]
    for each in order.confirm.split(BETWEEN):
        if each and each not in events:
            raise SettingsError(f"{label}: confirm: '{each}'; allowed is some of {BETWEEN.join(events)}")
    return order
