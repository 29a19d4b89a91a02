"""The checks of a camera that stands over a crop: the right way up, and where its file says."""

from collections.abc import Iterator

import numpy as np

from fieldnav.messages import Frame, Image
from fieldnav.perception.perceive import find
from fieldnav.perception.plants import find_plants
from fieldnav.perception.pose.camera_pose import PoseSighting, sight
from fieldnav.perception.pose.pose_estimate import CERTAIN, Departure, PoseEstimate
from fieldnav.pinhole import Pinhole
from fieldnav.preflight.finding import Finding, Verdict
from fieldnav.settings.camera import CameraLimits
from fieldnav.settings.crop import CropProfile

LEVEL = 1  # of a sighting's plane: positive where rows converge towards the top


def pose_findings(
    frame: Frame, crop: CropProfile, camera: Pinhole, limits: CameraLimits
) -> Iterator[Finding]:
    """What the rows in a frame tell of its camera."""
    seen = _sighting(frame.image, crop, camera)
    turned = None if seen else _sighting(np.ascontiguousarray(frame.image[::-1, ::-1]), crop, camera)
    called = f"{frame.camera.value} camera"
    if seen is None and turned is None:
        figure = "cannot be told: no two rows seen"
        yield Finding(f"{called} pose", Verdict.WARNING, figure, "stand the robot over rows of this crop")
        return
    upright = _uprightness(f"{called} upright", seen, turned)
    yield upright
    if seen is None or upright.verdict is Verdict.FAIL:
        return
    for departure in PoseEstimate.of_file(camera, crop).add(seen).departures(limits):
        advice = _advice(departure)
        verdict = Verdict.WARNING if advice else Verdict.OK
        yield Finding(f"{called} {departure.name}", verdict, str(departure), advice)


def _sighting(image: Image, crop: CropProfile, camera: Pinhole) -> PoseSighting | None:
    lane = find(image, crop, camera).lane
    if lane is None:
        return None
    return sight(lane.rows, find_plants(image, crop.vegetation, camera), crop, camera)


def _uprightness(check: str, seen: PoseSighting | None, turned: PoseSighting | None) -> Finding:
    """By which way the rows converge; `turned` is what the picture shows when it is turned round."""
    converging = _converging(seen) if seen else -_converging(turned) if turned else 0.0
    figure = f"rows converge towards the {'top' if converging > 0 else 'bottom'}"
    if converging > CERTAIN:
        return Finding(check, Verdict.OK, figure)
    if converging < -CERTAIN:
        return Finding(check, Verdict.FAIL, figure, "it hangs upside down: turn it, or its picture")
    return Finding(check, Verdict.WARNING, "cannot be told from these rows", "look at a picture of it")


def _converging(seen: PoseSighting) -> float:
    """How clearly rows converge towards the top, in standard deviations."""
    return float(seen.plane[LEVEL] / np.sqrt(seen.covariance[LEVEL, LEVEL]))


def _advice(departure: Departure) -> str:
    """What to do where the camera seems to look elsewhere than its file says; empty where it does not."""
    if departure.certain:
        return "knocked: set it back, or the robot file right"
    return "not certain from one view: check again a few metres on" if departure.off > departure.limit else ""
