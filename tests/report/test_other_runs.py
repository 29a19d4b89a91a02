"""A report of whatever run: finished, broken off, without a recording, damaged, hostile."""

import json
from dataclasses import replace

from fieldnav.journal.ledger import Ledger

from .conftest import RunMaker
from .made_run import STORY, STUCK
from .shown_page import page_of

HOSTILE = '</td></table><script>alert(1)</script><img src="http://evil/x" onerror=y>{{ 7*7 }}{% raw %}&amp;'


def test_hostile_texts_are_shown_and_not_obeyed(make_run: RunMaker) -> None:
    lines = [
        *STORY[:-1],
        replace(STORY[-1], event=HOSTILE, source=f"Forward.{HOSTILE}", reason=HOSTILE),
    ]
    directory = make_run(lines, recorded=True, name="story <script>$x$")
    directory.settings.write_text(f"options: {{{json.dumps(HOSTILE)}: {json.dumps(HOSTILE)}}}\n")

    page = page_of(directory)

    assert "script" not in page.tags
    assert not page.stray
    assert all(address.startswith("data:") for address in page.addresses)
    assert "<script>alert(1)</script>" in page.text("journal")
    assert "{{ 7*7 }}" in page.text("journal")
    assert "<script>alert(1)</script>" in page.text("settings")


def test_a_run_without_a_recording_says_what_is_missing(make_run: RunMaker) -> None:
    page = page_of(make_run())

    assert "There is no recording" in page.text("missing")
    assert STUCK in page.text("outcome")
    assert page.text("rows") == "Crop rows Not known without a recording."
    assert len(page.rows["journal"]) == 1 + len(STORY)


def test_of_many_holds_the_newest_are_told_and_the_others_counted(make_run: RunMaker) -> None:
    holds = [replace(STORY[-2], stamp_s=24.0 + index / 100) for index in range(100)]

    page = page_of(make_run([*STORY[:-2], *holds, STORY[-1]], recorded=True))

    assert "61 earlier ones are in the journal's table below." in page.text("stops")
    assert STUCK in page.text("stop-101").replace("Steering", "steering")
    assert len(page.rows["journal"]) == 1 + len(STORY) + 99


def test_a_run_that_is_being_driven_is_not_taken_for_broken_off(make_run: RunMaker) -> None:
    directory = make_run(STORY[:7], completed=None)

    with Ledger(directory.ledger):
        page = page_of(directory)

    told = "Still being driven: at 0:21.0 in lane 2 it was in Backward.Follow.Tracking."
    assert page.text("outcome").startswith(told)
    assert page.text("stops") == "Stops and holds None."


def test_a_finished_run_has_no_stops_to_tell(make_run: RunMaker) -> None:
    lines = (*STORY[:-2], replace(STORY[-1], event="last lane left", target="Finished", reason=""))

    page = page_of(make_run(lines, completed=True))

    assert page.text("outcome") == "Finished. 1 of 2 lanes done."
    assert page.text("stops") == "Stops and holds None."


def test_a_run_broken_off_in_the_middle_names_the_process(make_run: RunMaker) -> None:
    page = page_of(make_run(STORY[:7], completed=None))

    assert page.text("outcome").startswith(
        "Broken off at 0:21.0 in lane 2, in Backward.Follow.Tracking: process killed:"
    )
    assert "There is no summary.json" in page.text("missing")
    assert "Run --resume." in page.text("stop-1")


def test_a_killed_run_is_told_with_the_last_that_was_recorded(make_run: RunMaker) -> None:
    page = page_of(make_run(STORY[:7], recorded=True, completed=None, until_s=25.0))

    assert page.text("outcome").startswith("Broken off at 0:24.9 in lane 2, in Backward.Follow.Tracking:")
    assert "front camera at 0:24.8" in page.text("stop-1")
    assert page.rows["stop-1"][0][0] == "what was judged last before it"
