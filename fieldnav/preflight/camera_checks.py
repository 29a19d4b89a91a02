"""The checks of the cameras that need no crop: they give frames in time, and the frames show something."""

from collections.abc import Iterator, Mapping
from math import ceil
from pathlib import Path

from drivers.picture_folder import PICTURES
from fieldnav.messages import CameraName, Frame
from fieldnav.perception.pose.picture_quality import BLACK, WHITE, difference, quality, same
from fieldnav.preflight.finding import Finding, Verdict
from fieldnav.preflight.sampling import PATIENCE_S, Taken
from fieldnav.settings.camera import CameraSettings
from fieldnav.settings.shown_source import shown

LEAST_GAP_S = 0.005
"""No camera is faster than 200 frames a second; frames that came at once have no rate."""
SLOW = 0.8  # of the robot file's rate
LEAST_CONTRAST = 4.0  # grey levels; soil without a plant has 10 or more
LEAST_SHARPNESS = 50.0  # fields in focus have 190 or more, blurred by two pixels 30 or less
ALIKE = 3.0  # grey levels; two views of one scene differ by less, ends of a robot by 10 or more


def camera_findings(name: CameraName, taken: Taken, settings: CameraSettings) -> Iterator[Finding]:
    """How a camera's frames came, and what they look like."""
    check = f"{name.value} camera frames"
    if taken.failure:
        yield Finding(check, Verdict.FAIL, taken.failure)
        return
    yield _arrival(check, taken.frames, settings)
    if taken.frames:
        yield from _pictures(name, taken.frames, settings)


def _arrival(check: str, frames: list[Frame], settings: CameraSettings) -> Finding:
    if len(frames) < 2:  # noqa: PLR2004 - one frame has no rate
        return Finding(check, Verdict.FAIL, f"{len(frames)} within {PATIENCE_S:g} s", "replug it")
    first, last = frames[0], frames[-1]
    rate_hz = (last.sequence - first.sequence) / max(last.stamp_s - first.stamp_s, LEAST_GAP_S)
    figure = f"{settings.width_px}x{settings.height_px} px, {rate_hz:.1f} a second"
    if rate_hz < SLOW * settings.rate_hz:
        advice = f"rate_hz says {settings.rate_hz:g}: more light, or a faster port"
        return Finding(check, Verdict.WARNING, figure, advice)
    return Finding(check, Verdict.OK, figure)


def _pictures(name: CameraName, frames: list[Frame], settings: CameraSettings) -> Iterator[Finding]:
    """What the frames look like; sky says nothing of a camera."""
    seen = quality(frames[-1].image[ceil(settings.pinhole().top_px) :])
    check = f"{name.value} camera picture"
    figure = f"brightness {seen.brightness:.0f}, contrast {seen.contrast:.0f} of 255"
    if seen.brightness < BLACK:
        yield Finding(check, Verdict.FAIL, f"black: {figure}", "take the cap off, or make light")
    elif seen.brightness > WHITE:
        yield Finding(check, Verdict.FAIL, f"white: {figure}", "shade it, or set its exposure")
    elif seen.contrast < LEAST_CONTRAST:
        yield Finding(check, Verdict.FAIL, f"empty: {figure}", "see what covers the lens")
    else:
        yield Finding(check, Verdict.OK, figure)
    yield _liveliness(f"{name.value} camera lives", frames, settings)
    sharp = seen.sharpness >= LEAST_SHARPNESS
    advice = "" if sharp else f"{LEAST_SHARPNESS:g} or more is sharp: clean the lens, set its focus"
    verdict = Verdict.OK if sharp else Verdict.WARNING
    yield Finding(f"{name.value} camera sharpness", verdict, f"{seen.sharpness:.0f}", advice)


def _liveliness(check: str, frames: list[Frame], settings: CameraSettings) -> Finding:
    if not all(same(frames[0].image, frame.image) for frame in frames[1:]):
        return Finding(check, Verdict.OK, "its frames differ")
    if Path(settings.source).suffix.lower() in PICTURES:
        return Finding(check, Verdict.WARNING, "its source is one still picture")
    return Finding(check, Verdict.FAIL, f"frozen: {len(frames)} frames are one picture", "replug it")


def two_cameras(sources: Mapping[CameraName, CameraSettings], frames: Mapping[CameraName, Frame]) -> Finding:
    """Whether the two cameras are two, and not one that the file names twice."""
    check = "two cameras"
    front, rear = (sources[name].source for name in CameraName)
    opened = len(frames) == len(CameraName)
    if front == rear or (opened and Path(front).resolve() == Path(rear).resolve()):
        return Finding(check, Verdict.FAIL, f"both have the source {shown(front)}", "give each its own")
    if not opened:
        return Finding(check, Verdict.WARNING, "not compared: one gives no picture")
    apart = difference(*(frames[name].image for name in CameraName))
    figure = f"their pictures differ by {apart:.1f} grey levels"
    if apart < ALIKE:
        return Finding(check, Verdict.FAIL, figure, "both sources seem to be one camera")
    return Finding(check, Verdict.OK, figure)
