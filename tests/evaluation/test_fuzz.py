"""A few thousand bad frames and some hundred broken files; and that the fuzz notices what it looks for."""

import json
from functools import partial
from pathlib import Path
from random import Random

import can
import pytest

from drivers.thorvald import ThorvaldWheels
from fieldnav.cli.app import run
from fieldnav.errors import FieldnavError, SettingsError
from fieldnav.evaluation.fuzz import throw
from fieldnav.evaluation.fuzz_can import Bout, Part, fight
from fieldnav.evaluation.fuzz_files import Batch, code_has_run, fuzzed_file, judge, read_batch
from fieldnav.evaluation.fuzz_frames import FrameFuzz, written
from fieldnav.evaluation.fuzz_lane import tracking_mission
from fieldnav.evaluation.fuzz_originals import originals
from fieldnav.evaluation.fuzz_recording import good_telegrams
from fieldnav.evaluation.fuzz_run_files import Original
from fieldnav.evaluation.fuzz_targets import standing_driver, standing_mission
from fieldnav.messages import Wheel, WheelReport, WheelSetpoint

SEED = 7
FRAMES, BOUTS = 3000, 2
"""Of each standing part; with the lane 20,000 frames in all."""


@pytest.mark.parametrize("part", [Part.DRIVER, Part.MISSION, Part.MODULES])
@pytest.mark.parametrize("index", range(BOUTS))
def test_bad_frames_break_nothing_and_move_nothing(part: Part, index: int) -> None:
    fought = throw(Bout(part, index, FRAMES, SEED))

    assert (fought.crash, fought.motion) == (None, None)
    assert fought.frames == FRAMES


# A few false words on the wheels' motion for some seconds; a flood of everything.
@pytest.mark.parametrize(("index", "frames"), [(1, 30), (3, FRAMES)])
def test_a_mission_that_drives_among_bad_frames_keeps_its_lane_and_its_limits(
    index: int, frames: int
) -> None:
    fought = throw(Bout(Part.TRACKING, index, frames, SEED))

    assert (fought.crash, fought.motion) == (None, None)
    assert fought.frames > 0


def test_broken_files_are_read_or_refused_in_one_line() -> None:
    read = read_batch(Batch(0, 300, SEED))

    assert read.failures == ()
    assert 0 < read.accepted < read.files


def test_the_seed_decides_every_frame_and_every_file() -> None:
    def drawn(seed: int) -> list[str]:
        fuzz = FrameFuzz(Random(seed), good_telegrams())
        return [written(fuzz.draw(0.0)) for _ in range(200)]

    assert drawn(1) == drawn(1) != drawn(2)
    assert fuzzed_file(5, 1)[1] == fuzzed_file(5, 1)[1] != fuzzed_file(5, 2)[1]
    assert throw(Bout(Part.MODULES, 0, 500, 1)) == throw(Bout(Part.MODULES, 0, 500, 1))


def test_frames_of_every_kind_are_drawn_but_for_those_that_are_left_out() -> None:
    fuzz = FrameFuzz(Random(SEED), good_telegrams(), {0x201})
    frames = [fuzz.draw(1.5) for _ in range(5000)]

    assert {frame.dlc for frame in frames} == set(range(9))
    assert any(frame.is_extended_id for frame in frames)
    assert any(frame.is_remote_frame for frame in frames)
    assert any(frame.is_error_frame for frame in frames)
    assert {frame.timestamp for frame in frames} == {1.5}
    plain = [frame for frame in frames if not frame.is_extended_id]
    data = {f.arbitration_id for f in plain if not f.is_remote_frame and not f.is_error_frame}
    assert 0x201 not in data and {0x000, 0x181, 0x202, 0x484, 0x581, 0x701, 0x77F} <= data


class Credulous(ThorvaldWheels):
    """A driver that drives on, when it is told to stand, once a module says that it moves."""

    def poll(self, now_s: float) -> WheelReport:
        self.said = super().poll(now_s)
        return self.said

    def command(self, now_s: float, setpoints: dict[Wheel, WheelSetpoint]) -> None:
        moving = any(abs(module.speed_mps) > 1 for module in self.said.modules.values())
        if moving:
            module = next(iter(self._links.values())).module
            self._line.drive(now_s, module, 0.5)
        super().command(now_s, setpoints)


class Brittle(ThorvaldWheels):
    """A driver that did not think of a flag that a module can set."""

    def poll(self, now_s: float) -> WheelReport:
        report = super().poll(now_s)
        if any(not module.healthy for module in report.modules.values()):
            raise KeyError("no such flag")
        return report


class Racing(ThorvaldWheels):
    """A driver that puts four tenths on what it is told."""

    def command(self, now_s: float, setpoints: dict[Wheel, WheelSetpoint]) -> None:
        faster = {
            wheel: WheelSetpoint(point.speed_mps * 1.4, point.steering_rad)
            for wheel, point in setpoints.items()
        }
        super().command(now_s, faster)


def test_a_driver_that_moves_though_it_should_stand_is_caught_with_its_frame() -> None:
    prepare = partial(standing_driver, make_wheels=Credulous)
    bouts = [Bout(Part.DRIVER, index, FRAMES, SEED) for index in range(30)]

    fought = (fight(bout, prepare) for bout in bouts)
    moved = next((each.motion for each in fought if each.motion), None)

    assert moved
    assert "the host sent 201#" in moved.reason
    assert "frames " in moved.reason
    assert moved.again.startswith("fieldnav bench fuzz --seed 7 --again driver:")


@pytest.mark.parametrize("prepare", [standing_driver, standing_mission])
def test_a_driver_that_breaks_is_caught_whatever_it_raises(prepare: object) -> None:
    bouts = [Bout(Part.DRIVER, index, FRAMES, SEED) for index in range(6)]

    fought = (fight(bout, partial(prepare, make_wheels=Brittle)) for bout in bouts)

    crash = next((each.crash for each in fought if each.crash), None)
    assert crash and "KeyError: 'no such flag'" in crash.reason


def test_a_mission_that_drives_too_fast_is_caught() -> None:
    fought = fight(Bout(Part.TRACKING, 0, 50, SEED), partial(tracking_mission, make_wheels=Racing))

    assert fought.motion and "limit 0.6 m/s" in fought.motion.reason


def raising(error: Exception) -> Original:
    def read(path: Path) -> None:
        raise error

    return Original("some.yaml", "", read)


@pytest.mark.parametrize(
    ("error", "wrong"),
    [
        (SettingsError("PATH: rows: 3 is not allowed"), ""),
        (SettingsError("PATH: rows: 'a\nb' is not allowed"), "an error of 2 lines"),
        (SettingsError("PATH: rows: '\x1b[2J' is not allowed"), "no terminal should be sent"),
        (SettingsError("rows: 3 is not allowed"), "does not name the file"),
        (SettingsError(f"PATH: {'x' * 4000}"), "characters"),
        (FieldnavError("PATH: rows: 3 is not allowed"), "FieldnavError instead of SettingsError"),
        (KeyError("rows"), "KeyError: 'rows'"),
        (RecursionError(), "RecursionError"),
    ],
)
def test_an_error_that_is_not_one_clear_line_is_caught(error: Exception, wrong: str, tmp_path: Path) -> None:
    path = tmp_path / "some.yaml"
    error.args = tuple(str(said).replace("PATH", str(path)) for said in error.args)

    said, accepted, _ = judge(raising(error), path)

    assert not accepted
    assert wrong in said if wrong else said == ""


def test_a_loader_that_runs_what_a_file_names_is_caught(tmp_path: Path) -> None:
    obedient = Original("some.yaml", "", lambda path: code_has_run())

    assert judge(obedient, tmp_path / "some.yaml")[0] == "code of a file's choosing has run"


def test_every_good_file_is_accepted_before_it_is_changed(tmp_path: Path) -> None:
    for original in originals():
        path = original.place_in(tmp_path)
        path.write_text(original.text, encoding="utf-8")
        assert judge(original, path)[:2] == ("", True), original.name


def test_a_file_that_goes_wrong_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    broken = Original("some.yaml", "rows: 3\n", raising(KeyError("rows")).read)
    monkeypatch.setattr("fieldnav.evaluation.fuzz_files.originals", lambda: (broken,))

    read = read_batch(Batch(3, 4, SEED, tmp_path))

    assert (tmp_path / "3-some.yaml").read_bytes() == fuzzed_file(3, SEED)[1]
    assert str(tmp_path / "3-some.yaml") in read.failures[0].reason
    assert read.failures[0].again == "fieldnav bench fuzz --seed 7 --again files:3"


def test_the_command_repeats_one_case_and_reports_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["bench", "fuzz", "--seed", "7", "--again", "files:3", "--json"]) == 0

    document = json.loads(capsys.readouterr().out)
    rows = {row["metric"]: row for row in document["rows"]}
    assert (document["bench"], document["failures"]) == ("fuzz", [])
    assert rows["files"]["value"] == 1
    assert rows["unclear errors and worse"]["met"] is True


@pytest.mark.parametrize("case", ["wheel:3", "driver", "driver:x", "files:-1"])
def test_a_case_that_there_is_not_is_refused(case: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["bench", "fuzz", "--again", case]) == 2

    assert f"--again: '{case}' is not allowed" in capsys.readouterr().err


def test_a_frame_is_written_as_candump_writes_it() -> None:
    assert written(can.Message(arbitration_id=0x201, is_extended_id=False, data=b"\1\xff")) == "201#01FF"
    assert written(can.Message(arbitration_id=0x201, data=b"")) == "00000201#"
    assert written(can.Message(arbitration_id=0, is_extended_id=False, is_remote_frame=True)) == "000#R"
