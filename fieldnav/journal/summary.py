"""summary.json: a run in figures."""

from pathlib import Path

from pydantic import BaseModel, ConfigDict

from fieldnav.errors import FieldnavError, SettingsError
from fieldnav.journal.files import write_atomically
from fieldnav.settings.json_text import read_model
from fieldnav.settings.regular_file import open_regular


class _Figures(BaseModel):
    """Frozen; a figure that is not a number is written as null."""

    model_config = ConfigDict(frozen=True, ser_json_inf_nan="null")


class Lanes(_Figures):
    done: int
    total: int


class Switches(_Figures):
    attempted: int
    succeeded: int


class Headland(_Figures):
    """Empty space used beyond the row ends; None before the first switch."""

    mean: float | None = None
    max: float | None = None


class CrossTrack(_Figures):
    """Distance of the robot's centre from the lane's centre line."""

    mean: float | None
    std: float | None
    p95: float | None
    max: float | None


class Heading(_Figures):
    """Angle between the robot and the lane."""

    mean: float | None
    std: float | None
    max: float | None


class Truth(_Figures):
    """What only a simulation knows."""

    cross_track_cm: CrossTrack
    heading_deg: Heading
    crop_plants_run_over: int
    lanes_missed: int
    lanes_repeated: int


class LoopHealth(_Figures):
    """How late the rounds of the loop began, on the wall clock."""

    rounds: int
    late_p99_ms: float
    late_max_ms: float


class Summary(_Figures):
    """A run's figures; `truth` in simulation only, `loop` on a robot, `warnings` where there are any."""

    completed: bool
    lanes: Lanes
    distance_m: float
    duration_s: float
    wall_s: float
    realtime_factor: float
    transitions: int
    faults: int
    switches: Switches
    headland_m: Headland = Headland()
    warnings: tuple[str, ...] = ()
    truth: Truth | None = None
    loop: LoopHealth | None = None


def to_json(summary: Summary) -> str:
    """A summary as indented JSON; `truth`, `loop` and `warnings` are left out where there are none."""
    exclude = {name for name in ("truth", "loop", "warnings") if not getattr(summary, name)}
    return summary.model_dump_json(indent=2, exclude=exclude)


def write_summary(path: Path, summary: Summary) -> None:
    """Write the whole file or nothing. Raises OutputError."""
    write_atomically(path, f"{to_json(summary)}\n".encode())


def read_summary(path: Path) -> Summary | None:
    """A run's figures; None when it ended before they were written. Raises FieldnavError."""
    try:
        with open_regular(path) as file:
            return read_model(Summary, file.read())
    except FileNotFoundError:
        return None
    except OSError as error:
        raise FieldnavError(f"{path}: cannot be read: {error.strerror}") from error
    except SettingsError as error:
        raise FieldnavError(f"{path}: is not the summary of a run: {error}") from error
