"""All lines of a run's ledger: where the robot was, and where the lane began and ended."""

from pathlib import Path

from pydantic import ValidationError

from fieldnav.errors import FieldnavError
from fieldnav.journal.ledger import Booking


def bookings_of(path: Path) -> list[Booking]:
    """The whole lines of a ledger, none where there is no ledger. Raises FieldnavError."""
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        return []
    except OSError as error:
        raise FieldnavError(f"{path}: cannot be read: {error.strerror}") from error
    *texts, _ = content.split(b"\n")
    try:
        return [Booking.model_validate_json(text) for text in texts]
    except ValidationError as error:
        raise FieldnavError(f"{path}: holds a line that is none of a ledger's") from error
