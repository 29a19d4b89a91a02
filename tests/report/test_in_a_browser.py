"""report.html in a headless Chromium: it shows what the journal says, without an error or a request."""

import json
import os
import re
import shutil
import subprocess
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest

from fieldnav.report.writing import write_report

from .made_run import STORY, STUCK, written

NEEDED = "CI_NEEDS_BROWSER"
"""Where this is set, a machine without a browser is a failure."""
NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
QUIET = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--enable-logging=stderr",
    "--v=0",
    "--host-resolver-rules=MAP * ~NOTFOUND",
)
LONGEST_S = 120
TABLET_PX = 820
LONG_WORD = "unbroken" * 60
MEASURES = """<script>
{const it = document.documentElement; it.id = `over-${it.scrollWidth - it.clientWidth}`}
</script>"""
BROWSER = "not an origin"
"""How the browser's log calls the initiator of its own requests."""
POLICY = re.compile(r'<meta http-equiv="Content-Security-Policy"[^>]*>')


@dataclass(frozen=True, slots=True)
class Opened:
    """The page as the browser made it, what the browser said, and the addresses it asked for."""

    dom: str
    said: str
    requests: list[str]


class Browser:
    """A Chromium with a profile of its own."""

    def __init__(self, program: str, folder: Path) -> None:
        self._program, self._folder = program, folder

    def open(self, page: Path, width_px: int = 1400) -> Opened:
        net_log = self._folder / "net.json"
        options = (
            f"--user-data-dir={self._folder / 'profile'}",
            f"--log-net-log={net_log}",
            f"--window-size={width_px},1000",
            "--dump-dom",
        )
        done = subprocess.run(
            [self._program, *QUIET, *options, page.as_uri()],
            capture_output=True,
            text=True,
            timeout=LONGEST_S,
            check=True,
        )
        events = json.loads(net_log.read_text())["events"]
        return Opened(done.stdout, done.stderr, list(filter(None, map(asked_by_the_page, events))))


def asked_by_the_page(event: dict[str, Any]) -> str:
    """The address that a page's request is for; empty for one of the browser's own, and for other events."""
    params = event.get("params", {})
    return str(params.get("url", "")) if params.get("initiator", BROWSER) != BROWSER else ""


@pytest.fixture
def browser(tmp_path: Path) -> Browser:
    program = next((found for name in NAMES if (found := shutil.which(name))), None)
    if program is None:
        said = f"needs a browser to look with: none of {', '.join(NAMES)} is on this machine"
        assert not os.environ.get(NEEDED), said
        pytest.skip(said)
    return Browser(program, tmp_path)


def test_it_shows_what_the_journal_says_without_an_error_or_a_request(
    browser: Browser, tmp_path: Path
) -> None:
    page = write_report(written(tmp_path / "runs", STORY, recorded=True, completed=False))

    opened = browser.open(page)

    text = re.sub(r"<[^>]*>", "", opened.dom)
    assert all(line.event in text and line.source in text and line.target in text for line in STORY)
    assert STUCK in text
    assert "1 forward" in text
    assert "2 backward, not done" in text
    assert opened.dom.count("<tr") == page.read_text().count("<tr")
    assert "CONSOLE" not in opened.said
    assert [url for url in opened.requests if not url.startswith("data:")] == []


def test_what_a_page_asks_for_and_complains_of_would_be_noticed(browser: Browser, tmp_path: Path) -> None:
    page = tmp_path / "bad.html"
    page.write_text('<img src="http://outside.example/x.png"><script>nothing.there()</script>')

    opened = browser.open(page)

    assert "CONSOLE" in opened.said
    assert any("outside.example" in url for url in opened.requests)


def test_nothing_is_wider_than_a_tablet(browser: Browser, tmp_path: Path) -> None:
    lines = (*STORY[:-1], replace(STORY[-1], source=LONG_WORD, event=LONG_WORD, reason=LONG_WORD))
    report = write_report(
        written(tmp_path / "runs", lines, recorded=True, completed=False, name=LONG_WORD[:100])
    )
    page = tmp_path / "measured.html"
    page.write_text(POLICY.sub("", report.read_text()).replace("</body>", f"{MEASURES}</body>"))

    opened = browser.open(page, TABLET_PX)

    assert 'id="over-0"' in opened.dom
