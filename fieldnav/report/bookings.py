"""All lines of a run's ledger: where the robot was, and where the lane began and ended."""

from pathlib import Path

from fieldnav.errors import FieldnavError, SettingsError
from fieldnav.journal.ledger import Booking
from fieldnav.settings.json_text import read_model
from fieldnav.settings.regular_file import open_regular


def bookings_of(path: Path) -> list[Booking]:
    """The whole lines of a ledger, none where there is no ledger. Raises FieldnavError."""
    try:
        with open_regular(path) as file:
            content = file.read()
    except FileNotFoundError:
        return []
    except OSError as error:
        raise FieldnavError(f"{path}: cannot be read: {error.strerror}") from error
    *texts, _ = content.split(b"\n")
    bookings = []
    for number, text in enumerate(texts, start=1):
        try:
            bookings.append(read_model(Booking, text))
        except SettingsError as error:
            raise FieldnavError(f"{path}: line {number} is none of a ledger's: {error}") from error
    return bookings
