"""What must be confirmed is asked about, and a yes holds once."""

import pytest

from fieldnav.errors import SettingsError
from fieldnav.operator.confirmation import EVENTS, QUESTIONS, Confirmations, parse_confirmations
from states.names import Event

ASKED = [Event.LANE_LEFT, Event.LANE_ENDED]


@pytest.mark.parametrize(
    ("words", "events"),
    [
        ("switch,exit", {Event.LANE_LEFT, Event.LANE_ENDED}),
        (" exit ", {Event.LANE_ENDED}),
        ("switch,switch", {Event.LANE_LEFT}),
        ("", set()),
    ],
)
def test_words_stand_for_the_events_they_name(words: str, events: set[Event]) -> None:
    assert parse_confirmations(words) == events


@pytest.mark.parametrize(
    ("words", "wrong"), [("swich", "swich"), ("exit,", ""), ("exit;switch", "exit;switch")]
)
def test_a_wrong_word_is_one_line_that_says_what_is_allowed(words: str, wrong: str) -> None:
    with pytest.raises(SettingsError) as caught:
        parse_confirmations(words)
    assert str(caught.value) == f"--confirm: '{wrong}': allowed are switch, exit, with a comma between"


def test_every_word_has_an_event_and_every_event_a_question() -> None:
    assert set(EVENTS.values()) == set(QUESTIONS)


@pytest.mark.parametrize("event", Event)
def test_only_what_was_chosen_is_asked_about(event: Event) -> None:
    confirmations = Confirmations([Event.LANE_LEFT])
    assert confirmations.asks(event) is (event is Event.LANE_LEFT)


@pytest.mark.parametrize("event", ASKED)
def test_it_asks_until_the_yes_which_holds_once(event: Event) -> None:
    confirmations = Confirmations(ASKED)
    assert confirmations.asks(event) and confirmations.asks(event)
    assert QUESTIONS[event] in confirmations.question

    assert confirmations.grant()
    assert confirmations.question == ""

    assert not confirmations.asks(event)
    assert confirmations.asks(event)


def test_a_yes_to_one_question_is_none_to_the_other() -> None:
    confirmations = Confirmations(ASKED)
    confirmations.asks(Event.LANE_ENDED)
    confirmations.grant()
    assert confirmations.asks(Event.LANE_LEFT)
    assert QUESTIONS[Event.LANE_LEFT] in confirmations.question
    assert confirmations.asks(Event.LANE_ENDED)


def test_a_resume_without_a_question_grants_nothing() -> None:
    confirmations = Confirmations(ASKED)
    assert not confirmations.grant()
    assert confirmations.asks(Event.LANE_LEFT)


def test_a_yes_that_was_withdrawn_is_asked_for_again() -> None:
    confirmations = Confirmations(ASKED)
    confirmations.asks(Event.LANE_LEFT)
    confirmations.grant()
    confirmations.withdraw()
    assert confirmations.question == ""
    assert confirmations.asks(Event.LANE_LEFT)
