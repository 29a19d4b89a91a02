"""The line between operator and mission: one line of JSON asks, one line of JSON answers."""

import json
from dataclasses import asdict

from pydantic import BaseModel, ConfigDict, TypeAdapter, ValidationError

from fieldnav.errors import FieldnavError, SettingsError
from fieldnav.operator.request import Answer, Command
from fieldnav.settings.json_text import parse_json, read_model

END = b"\n"
LONGEST_REQUEST_BYTES = 1024
"""Without its end; the longest there is has 20. Our choice."""
LONGEST_ANSWER_BYTES = 1 << 16
"""A status with all the warnings it may hold takes a tenth of it."""

ALLOWED = (
    f'one line such as {{"command": "status"}}, the command one of {", ".join(c.value for c in Command)}'
)
"""What a request must be, for the refusal of everything else."""


class _Asked(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)

    command: Command


_ANSWER = TypeAdapter(Answer)


def request_line(command: Command) -> bytes:
    """A command as it is sent."""
    return json.dumps({"command": command.value}).encode() + END


def read_request(line: bytes) -> Command:
    """The command in a line without its end. Raises FieldnavError for everything else."""
    try:
        return read_model(_Asked, line).command
    except SettingsError as error:
        raise FieldnavError(f"not understood: {error}; allowed is {ALLOWED}") from error


def answer_line(answer: Answer) -> bytes:
    """An answer as it is sent; never raises: what is no Unicode is replaced, what is no JSON becomes text."""
    return json.dumps(asdict(answer), ensure_ascii=False, default=str).encode(errors="replace") + END


def read_answer(line: bytes) -> Answer:
    """The answer in a line. Raises FieldnavError where it is none."""
    try:
        parse_json(line)
        return _ANSWER.validate_json(line)
    except (SettingsError, ValidationError) as error:
        raise FieldnavError("the mission's answer is not understood; is it of another version?") from error
