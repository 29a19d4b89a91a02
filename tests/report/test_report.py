"""report.html tells what the run's directory knows, whatever is missing or broken in it."""

from fieldnav.journal.entry import Entry
from fieldnav.messages import Bound, Evidence
from fieldnav.report.writing import write_report

from .conftest import RunMaker
from .made_run import BACK, BLACK, STORY, STUCK
from .shown_page import ShownPage, page_of

LARGEST_BYTES = 3_000_000


def test_the_first_sentence_says_where_and_why_the_run_stopped(make_run: RunMaker) -> None:
    page = page_of(make_run(recorded=True))

    assert (
        page.text("outcome")
        == f"Stopped at 0:26.0 in lane 2, in Backward.Follow.Tracking: {STUCK}. 1 of 2 lanes done."
    )


def test_every_line_of_the_journal_is_in_its_table(make_run: RunMaker) -> None:
    page = page_of(make_run(recorded=True))

    shown = [(row[3], row[4], row[5]) for row in page.rows["journal"][1:]]
    assert shown == [(line.event, line.source, line.target) for line in STORY]


def test_a_stop_is_told_with_cause_advice_and_picture(make_run: RunMaker) -> None:
    page = page_of(make_run(recorded=True))

    told = page.text("stop-2")
    assert "Stop at 0:26.0" in told
    assert STUCK in told.replace("Steering", "steering")
    assert "Look for a stone or a stalk." in told
    assert "needs a reset" in told
    assert "front camera at" in told
    assert BLACK in page.text("stop-1").replace("Camera", "camera", 1)


def test_a_stop_from_outside_shows_what_was_judged_last_before_it(make_run: RunMaker) -> None:
    page = page_of(make_run(recorded=True))

    assert page.rows["stop-2"][0][0] == "what was judged last before it"
    assert ["rows poorly seen over", "0 m", "> 0.25", "-0.25 m", "rows lost"] in page.rows["stop-2"]


def test_a_lane_is_told_with_what_the_robot_judged_of_it(make_run: RunMaker) -> None:
    page = page_of(make_run(recorded=True))

    first, second = page.rows["lanes"][1:]
    assert first == ["1 forward", "5.5 m", "0:19.5", "2.0 / 2.0", "1.0 / 1.0", "3", "0.45 m", "0", "0"]
    assert second[0] == "2 backward, not done"
    assert second[-1] == "2"


def test_the_crop_rows_are_told_lane_by_lane(make_run: RunMaker) -> None:
    page = page_of(make_run(recorded=True))

    assert page.rows["rows"][1] == ["1", "0.60", "67 %", "2.0 of 3.0", "17", "0"]


def test_what_nearly_came_is_told_with_its_picture(make_run: RunMaker) -> None:
    page = page_of(make_run(recorded=True))

    told = page.text("near-misses")
    assert "Nearly: rows lost" in told
    assert "0:05.0, lane 1, Forward.Follow.Tracking; 8 % of a threshold was lacking" in told
    assert "front camera at 0:04.9" in told


def test_battery_temperature_and_ticks_are_told(make_run: RunMaker) -> None:
    told = page_of(make_run(recorded=True)).text("health")

    assert "80 % at the beginning, 77 % at the end" in told
    assert "52.5 V" in told
    assert "31 °C" in told
    assert "100 ms in the median" in told


def test_the_way_by_dead_reckoning_stands_in_for_a_map(make_run: RunMaker) -> None:
    page = page_of(make_run(recorded=True))

    assert "dead reckoning" in page.text("map")
    assert sum(address.startswith("data:image/png") for address in page.addresses) == 1


def test_the_settings_are_in_it(make_run: RunMaker) -> None:
    page = page_of(make_run())

    assert ["rows.per_lane", "3"] in page.rows["settings"]
    assert ["name", "sugar-beet"] in page.rows["settings"]


def test_one_file_holds_everything_and_leads_nowhere(make_run: RunMaker) -> None:
    path = write_report(make_run(recorded=True))

    page = ShownPage(path)
    assert page.addresses
    assert all(address.startswith("data:") for address in page.addresses)
    assert not {"script", "iframe", "object", "form", "base"} & set(page.tags)
    assert "url(" not in path.read_text()
    assert "@import" not in path.read_text()
    assert path.stat().st_size < LARGEST_BYTES
    assert not page.stray


def test_the_same_run_gives_the_same_report(make_run: RunMaker) -> None:
    directory = make_run(recorded=True)

    first = write_report(directory).read_bytes()

    assert write_report(directory).read_bytes() == first


def test_a_stop_that_follows_at_once_shows_what_led_to_it(make_run: RunMaker) -> None:
    beside = Evidence("rows where the wheels will go", 1, 0, "rows", bound=Bound.AT_MOST)
    refused = Entry(25.98, "lane refused", BACK, "Backward.Sidestep.Returning", 2, 3, (beside,))
    fails = Entry(26.0, "fail", "Backward.Sidestep.Returning", "Fault.Recoverable", 2, 3)

    page = page_of(make_run([*STORY[:7], refused, fails]))

    headings = [row[0] for row in page.rows["stop-1"]]
    assert f"what {BACK} had judged just before" in headings
    assert "rows where the wheels will go" in headings
