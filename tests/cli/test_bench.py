"""`fieldnav bench`: the table, the JSON, what is refused, and which fieldnav was measured."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from fieldnav import __version__
from fieldnav.cli.app import run
from fieldnav.cli.bench_report import document, markdown, report_table
from fieldnav.cli.bench_wide import wide_markdown, wide_table
from fieldnav.cli.checkout import commit, machine
from fieldnav.cli.console import out
from fieldnav.evaluation.benchmark import Better, Failure, Figure, LeftOut, Report

REPORT = Report(
    (
        Figure("field", "F1", 0.962, 0.031, 0.95, 0.54, "the paper"),
        Figure("field", "error (cm)", 2.5, goal=1.2, better=Better.LOWER),
        Figure("field", "error of none (cm)", float("nan"), float("nan"), goal=1.2, better=Better.LOWER),
        Figure("field", "count", 12345.0),
    ),
    (LeftOut("photographs", "there is no folder data/[crbd]"),),
)


def error(capsys: pytest.CaptureFixture[str]) -> str:
    """The one line on standard error; nothing may stand on standard output."""
    captured = capsys.readouterr()
    lines = captured.err.splitlines()
    assert captured.out == "" and len(lines) == 1, captured
    return lines[0]


def shown(capsys: pytest.CaptureFixture[str]) -> list[str]:
    """The table's lines, one blank between words."""
    out().print(report_table("title", REPORT))
    return [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]


def test_the_table_has_each_figure_beside_its_goal_and_the_best_known(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert shown(capsys)[:-1] == [
        "title",
        "case metric value goal best known source met",
        "field F1 0.962 +- 0.031 >= 0.95 0.540 the paper yes",
        "field error (cm) 2.50 <= 1.2 no",
        "field error of none (cm) none +- none <= 1.2 no",
        "field count 12345",
    ]


@pytest.mark.parametrize(
    ("value", "goal", "better", "said"),
    [
        (0.7998, 0.8, Better.HIGHER, "0.7998"),
        (0.79999, 0.8, Better.HIGHER, "0.79999"),
        (0.8, 0.8, Better.HIGHER, "0.800"),
        (3.998, 4.0, Better.HIGHER, "3.998"),
        (1.5004, 1.5, Better.LOWER, "1.5004"),
        (1.5 + 1e-9, 1.5, Better.LOWER, "1.500000"),
        (99.96, 100.0, Better.HIGHER, "99.96"),
    ],
)
def test_a_figure_that_just_misses_its_goal_does_not_read_as_if_it_met_it(
    value: float, goal: float, better: Better, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    out().print(report_table("", Report((Figure("field", "figure", value, goal=goal, better=better),))))

    line = capsys.readouterr().out.splitlines()[-1].split()
    assert line[2] == said


def test_the_table_says_what_was_left_out_and_why(capsys: pytest.CaptureFixture[str]) -> None:
    assert shown(capsys)[-1] == "photographs left out: there is no folder data/[crbd]"


def test_a_bar_in_a_name_breaks_no_table_of_a_document() -> None:
    line = markdown("title", Report((Figure("near view, a|b", "F1", 1.0),))).splitlines()[-1]

    assert line.startswith("| near view, a\\|b | F1 | ")


def test_the_document_is_what_programs_expect() -> None:
    made = document("detection", "abc", REPORT)

    assert list(made) == ["bench", "commit", "rows", "left_out"]
    assert (made["bench"], made["commit"]) == ("detection", "abc")
    assert made["rows"][0] == {
        "case": "field",
        "metric": "F1",
        "value": 0.962,
        "std": 0.031,
        "goal": 0.95,
        "best_known": 0.54,
        "source": "the paper",
        "met": True,
    }
    assert [row["met"] for row in made["rows"]] == [True, False, False, None]
    assert made["left_out"] == [{"part": "photographs", "reason": "there is no folder data/[crbd]"}]


def test_a_figure_that_could_not_be_formed_is_null_and_the_document_is_json() -> None:
    text = json.dumps(document("detection", "abc", REPORT), allow_nan=False)

    assert json.loads(text)["rows"][2]["value"] is None


def test_a_figure_measured_by_numpy_is_json_too() -> None:
    figures = (
        Figure("case", "metric", np.float64(0.5), goal=1.0),
        Figure("case", "more", np.float64(2), goal=1.0),
    )

    rows = json.loads(json.dumps(document("bench", "commit", Report(figures))))["rows"]

    assert [row["met"] for row in rows] == [False, True]


@pytest.mark.long  # its parts: tests/evaluation; the command on one case: tests/evaluation/test_fuzz.py
def test_a_benchmark_succeeds_whatever_its_figures_are_and_says_what_it_left_out(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["bench", "detection", "--quick", "--json", "--data", str(tmp_path)]) == 0

    printed = json.loads(capsys.readouterr().out)
    assert printed["bench"] == "detection" and printed["commit"]
    assert {"beans", "sim-curved", "no rows: bare soil"} <= {row["case"] for row in printed["rows"]}
    absent = {part["reason"] for part in printed["left_out"]}
    assert {
        f"there is no folder {tmp_path / name}"
        for name in ("near_nadir_jw", "crbd", "crdld", "no_rows", "row_faults")
    } <= absent


@pytest.mark.parametrize("name", ["detection", "speed"])
def test_a_folder_of_photographs_that_does_not_exist_is_refused(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["bench", name, "--data", str(tmp_path / "none"), "--json"]) == 2

    line = error(capsys)
    assert line.startswith(f"error: --data {tmp_path}/none: there is no such folder; allowed is")


def test_the_environment_names_the_folder_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("FIELDNAV_DATA", str(tmp_path / "elsewhere"))

    assert run(["bench", "detection"]) == 2

    assert f"{tmp_path}/elsewhere: there is no such folder" in error(capsys)


@pytest.mark.parametrize("threads", ["0", "-1", "257", "two"])
def test_a_count_of_threads_that_cannot_be_is_refused(
    threads: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["bench", "speed", "--threads", threads]) == 2

    assert "--threads" in error(capsys)


def test_a_folder_for_the_plot_that_cannot_be_made_is_refused_before_measuring(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()

    assert run(["bench", "detection", "--plot", str(tmp_path / "file" / "plots")]) == 2

    assert f"--plot {tmp_path}/file/plots: cannot be written here" in error(capsys)


HELP = {
    "bench": ("detection", "navigation", "switching", "speed"),
    "bench detection": ("--quick", "FIELDNAV_DATA"),
    "bench speed": ("--quick", "FIELDNAV_DATA"),
    "bench navigation": ("--quick", "--fields", "--seeds", "--length", "--jobs", "--plot"),
    "bench switching": ("--quick", "--switches", "--seed", "--jobs", "--plot"),
}


@pytest.mark.parametrize("command", HELP)
def test_help_reads(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*command.split(), "--help"]) == 0

    said = capsys.readouterr().out
    assert all(word in said for word in HELP[command]), said


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["navigation", "--fields", "demo"], "--fields demo: unknown; allowed are sim-curved, "),
        (["navigation", "--seeds", "0"], "--seeds"),
        (["navigation", "--length", "3"], "--length"),
        (["navigation", "--jobs", "0"], "--jobs"),
        (["switching", "--switches", "0"], "--switches"),
        (["switching", "--seed", "-1"], "--seed"),
    ],
    ids=" ".join,
)
def test_missions_that_cannot_be_driven_are_refused(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["bench", *arguments]) == 2

    assert said in error(capsys)


@pytest.mark.parametrize("name", ["navigation", "switching"])
def test_a_folder_for_the_pictures_that_cannot_be_made_is_refused_before_driving(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()

    assert run(["bench", name, "--plot", str(tmp_path / "file" / "plots")]) == 2

    assert f"--plot {tmp_path}/file/plots: cannot be written here" in error(capsys)


def test_a_failure_is_a_line_of_the_table_and_of_the_document(capsys: pytest.CaptureFixture[str]) -> None:
    failure = Failure("beans, seed 4", "no row in sight", "fieldnav simulate beans --seed 4")
    report = Report((), failures=(failure,))

    out().print(report_table("title", report))

    line = " ".join(capsys.readouterr().out.splitlines()[-1].split())
    assert line == "beans, seed 4 failed: no row in sight; again: fieldnav simulate beans --seed 4"
    assert "failed: no row in sight" in markdown("title", report)
    assert document("navigation", "abc", report)["failures"] == [
        {"case": "beans, seed 4", "reason": "no row in sight", "again": "fieldnav simulate beans --seed 4"}
    ]
    assert document("navigation", "abc", Report((), failures=()))["failures"] == []


def test_a_goal_with_a_deviation_is_shown_with_it(capsys: pytest.CaptureFixture[str]) -> None:
    figure = Figure("field", "error", 1.0, 0.9004, goal=1.2, goal_std=0.9, better=Better.LOWER)

    out().print(report_table("", Report((figure,))))

    line = " ".join(capsys.readouterr().out.splitlines()[-1].split())
    assert line == "field error 1.0000 +- 0.9004 <= 1.2 +- 0.9 no"
    assert document("bench", "abc", Report((figure,)))["rows"][0]["goal_std"] == 0.9


@pytest.mark.long  # its parts: tests/evaluation/test_navigation.py
def test_a_lane_is_driven_both_ways_judged_and_drawn(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    driving = ["navigation", "--quick", "--fields", "potato", "--length", "4"]
    assert run(["bench", *driving, "--json", "--plot", str(tmp_path)]) == 0

    captured = capsys.readouterr()
    printed = json.loads(captured.out)
    assert captured.err == "" and printed["failures"] == [] and printed["left_out"] == []
    rows = {(row["case"], row["metric"]): row for row in printed["rows"]}
    assert {case for case, _ in rows} == {"potato", "potato (paper's finder and control)"}
    error_row = rows["potato", "cross-track error (cm)"]
    assert 0 < error_row["value"] < 10 and error_row["goal_std"] == 0.6
    assert rows["potato", "length driven (%)"]["value"] == 100
    assert sorted(path.name for path in tmp_path.iterdir()) == ["navigation-potato.png", "navigation.png"]


def git(folder: Path, *arguments: str) -> str:
    """Run git there, and nowhere else: a hook that runs the tests tells git of another repository."""
    plain = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
    name = ["-c", "user.name=nobody", "-c", "user.email=nobody@example.org", "-c", "commit.gpgsign=false"]
    command = ["git", "-C", str(folder), *name, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=plain)
    return done.stdout.strip()


def test_figures_name_the_commit_and_whether_files_differ_from_it(tmp_path: Path) -> None:
    git(tmp_path, "init", "--quiet")
    (tmp_path / "file").write_text("one", encoding="utf-8")
    git(tmp_path, "add", "file")
    git(tmp_path, "commit", "--quiet", "--message", "first")
    head = git(tmp_path, "rev-parse", "HEAD")

    clean = commit(tmp_path)
    (tmp_path / "file").write_text("two", encoding="utf-8")

    assert clean == head[:12]
    assert commit(tmp_path) == f"{head[:12]}-dirty"


def test_an_installed_fieldnav_names_its_version_even_within_someone_elses_repository(tmp_path: Path) -> None:
    git(tmp_path, "init", "--quiet")
    git(tmp_path, "commit", "--quiet", "--allow-empty", "--message", "theirs")
    inside = tmp_path / "lib" / "python"
    inside.mkdir(parents=True)

    assert commit(inside) == __version__


def test_the_machine_is_named_with_its_processors() -> None:
    assert "processor" in machine()


WIDE = Report(
    (
        Figure("beans", "error (cm)", 1.0, 0.5, 0.9, 3.49, "the paper", Better.LOWER, 0.7),
        Figure("beans (paper's)", "error (cm)", 2.0, 0.5, None, 3.49, "the paper", Better.LOWER),
        Figure("beans", "stops", 0.0, goal=0.0, better=Better.LOWER),
    ),
    (LeftOut("a gap", "the lane is too short for its gap"),),
    (Failure("beans, seed 4", "no row in sight", "fieldnav simulate beans --seed 4"),),
)


def test_cases_that_are_alike_are_a_line_each_above_their_goals_and_the_best_known(
    capsys: pytest.CaptureFixture[str],
) -> None:
    out().print(wide_table("title", WIDE))

    lines = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    assert lines == [
        "title",
        "case error (cm) stops",
        "beans 1.00 +- 0.50 (missed) 0.00",
        "goal <= 0.9 +- 0.7 <= 0",
        "best known 3.49 (the paper)",
        "beans (paper's) 2.00 +- 0.50",
        "a gap: left out: the lane is too short for its gap",
        "beans, seed 4: failed: no row in sight; again: fieldnav simulate beans --seed 4",
    ]


def test_the_wide_table_of_a_document_says_the_same() -> None:
    lines = wide_markdown("title", WIDE).splitlines()

    assert lines[2:7] == [
        "| case | error (cm) | stops |",
        "| --- | ---: | ---: |",
        "| beans | 1.00 +- 0.50 (missed) | 0.00 |",
        "|   goal | <= 0.9 +- 0.7 | <= 0 |",
        "|   best known | 3.49 (the paper) |  |",
    ]
    assert lines[-1].startswith("beans, seed 4: failed: no row in sight; again: ")
