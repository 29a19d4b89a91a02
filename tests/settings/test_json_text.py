"""JSON that people can touch is read strictly: what readers disagree about is refused with its key."""

import pytest
from pydantic import BaseModel, ConfigDict, Field

from fieldnav.errors import SettingsError
from fieldnav.settings.json_text import read_model


class Read(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    lane: int = Field(ge=1, le=9)
    way_m: float = 0.0
    inner: dict[str, int] = Field(default_factory=dict)


def test_a_plain_document_is_read() -> None:
    assert read_model(Read, b'{"lane": 3, "way_m": 2, "inner": {"a": 1}}') == Read(
        lane=3, way_m=2, inner={"a": 1}
    )


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (b'{"lane": 1, "lane": 2}', "lane: is given twice; allowed is once"),
        (b'{"lane": 1, "inner": {"a": 1, "a": 1}}', "a: is given twice; allowed is once"),
        (b'{"lane": 1, "la\\u006ee": 2}', "lane: is given twice; allowed is once"),
        (b'{"lane": NaN}', "NaN: is not allowed; allowed are finite numbers"),
        (b'{"lane": 1, "way_m": -Infinity}', "-Infinity: is not allowed; allowed are finite numbers"),
        (b'{"lane": 1, "way_m": 1e999}', "way_m: Infinity is not allowed; allowed is a number"),
        (b'{"lane": ' + b"9" * 6000 + b"}", "is no JSON"),
        (b'{"lane": 1180591620717411303424}', "lane: 1180591620717411303424 is not allowed; "),
        (b'{"lane": "3"}', "lane: '3' is not allowed; allowed is a whole number from 1 to 9; write 3"),
        (b'{"lane": true}', "lane: true is not allowed"),
        (b'{"lane": 1, "speed": 2}', "speed: 2: there is no such key"),
        (b"{}", "lane: is missing; allowed is a whole number from 1 to 9"),
        (b"[1]", "[1] is not allowed; allowed is a group of the keys lane, way_m, inner"),
        (b'{"lane": 1}{', "is no JSON"),
        (b"\xff", "is no text in UTF-8"),
        ('{"lane": 1}'.encode("utf-16"), "is no text in UTF-8"),
        (b"[" * 100_000, "is no JSON"),
        (b'{"\\ud800": 1, "lane": 1}', ""),
    ],
)  # fmt: skip
def test_a_doubtful_document_is_refused_with_key_value_and_what_is_allowed(text: bytes, said: str) -> None:
    with pytest.raises(SettingsError) as caught:
        read_model(Read, text)

    assert str(caught.value).startswith(said)
    assert "\n" not in str(caught.value)
