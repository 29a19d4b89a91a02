"""A request that could be read in two ways is obeyed in neither."""

import pytest

from fieldnav.errors import FieldnavError
from fieldnav.operator.request import Command
from fieldnav.operator.wire import read_answer, read_request, request_line


@pytest.mark.parametrize("command", Command)
def test_a_request_is_read_as_it_was_sent(command: Command) -> None:
    assert read_request(request_line(command).rstrip()) is command


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (b'{"command":"status","command":"stop"}', "command: is given twice; allowed is once"),
        (b'{"command":"status","\\u0063ommand":"stop"}', "command: is given twice; allowed is once"),
        (b'{"command":"stop","force":true}', "force: true: there is no such key"),
        (b'{"command":1}', "command: 1 is not allowed"),
        (b'{"command":["stop"]}', "command: "),
        (b'{"command":NaN}', "NaN: is not allowed"),
        (b'{"command":' + b"9" * 900 + b"}", "command: "),
        (b'"stop"', "'stop' is not allowed"),
        (b"stop", "is no JSON"),
        (b"[" * 1000, "is no JSON"),
        ('{"command":"stop"}'.encode("utf-16"), "is no text in UTF-8"),
    ],
)
def test_a_request_that_is_none_says_what_is_wrong_and_what_is_allowed(line: bytes, said: str) -> None:
    with pytest.raises(FieldnavError) as caught:
        read_request(line)

    assert str(caught.value).startswith(f"not understood: {said}")
    assert 'allowed is one line such as {"command": "status"}' in str(caught.value)


def test_an_answer_with_a_key_twice_is_not_understood() -> None:
    with pytest.raises(FieldnavError, match="is not understood"):
        read_answer(b'{"ok": false, "ok": true, "said": "stopped"}')
