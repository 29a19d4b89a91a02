"""A field of lanes as plants, and a robot that steps sideways over it: what it sees, what its wheels say."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import pytest

from fieldnav.messages import Centres
from fieldnav.perception.canopy import canopy_plane
from fieldnav.perception.sidestep.following import follow
from fieldnav.perception.sidestep.passing_rows import Crossing, begin
from fieldnav.perception.sidestep.wheel_motion import Travelled
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile

FRAME_M = 0.01
"""0.15 m/s at 15 frames/s."""
PITCH_M = 1.5
ROW_END_M = (1.15, 2.4)
"""The rows begin where the lower half of the trailing view ends."""
HEADING_SD = 0.015

Missing = Iterable[tuple[int, int]]


def lanes(
    crop: CropProfile,
    numbers: Iterable[int],
    without: Missing = (),
    uneven: float = 0.0,
    scatter_m: float = 0.015,
    seed: int = 1,
) -> np.ndarray:
    """Plants of whole lanes, shape (n, 2), lane 0 under the robot, the others to its left.

    without: (lane, row from the inside) not sown; uneven: share of the spacing that rows may be off.
    """
    rng = np.random.default_rng(seed)
    count, missing = crop.rows.per_lane, set(without)
    plants = []
    for lane in numbers:
        off = rng.uniform(-1, 1, count) * uneven * crop.rows.spacing_m / 2
        places = (
            lane * PITCH_M + (np.arange(count) - (count - 1) / 2) * crop.rows.spacing_m + off - off.mean()
        )
        for row, place in enumerate(places):
            x = np.arange(*ROW_END_M, crop.plants.spacing_m) + rng.uniform(0, crop.plants.spacing_m)
            y = place + rng.normal(0, scatter_m, x.shape)
            if (lane, row) not in missing:
                plants.append(np.stack([x, y], axis=-1))
    return np.concatenate(plants)


def centres(
    plants_m: np.ndarray, moved_m: float, crop: CropProfile, camera: Pinhole, share: float = 1.0
) -> Centres:
    """What the camera sees of the plants when the robot has moved to the left; `share` is their size."""
    plane = canopy_plane(camera, crop)
    at = plane.to_image(plants_m - [0.0, moved_m])
    inside = (at >= 0).all(axis=1) & (at[:, 0] < camera.width_px) & (at[:, 1] < camera.height_px)
    at = at[inside]
    side_px = share * crop.plants.canopy_width_m * plane.pixels_per_metre(at[:, 1])
    return Centres(at, side_px**2, at[:, 1] - side_px / 2, at[:, 1] + side_px / 2)


def mirrored(seen: Centres, camera: Pinhole) -> Centres:
    return replace(seen, position_px=np.array([camera.width_px - 1.0, 0.0]) + seen.position_px * [-1, 1])


def begun(crop: CropProfile, camera: Pinhole, outward: int = 1) -> Crossing:
    """The rows of the lane that the robot stands over, exactly known."""
    plane, count = canopy_plane(camera, crop), crop.rows.per_lane
    places = [((count - 1) / 2 - row) * crop.rows.spacing_m for row in range(count)]
    rows = tuple(plane.row_in_image(place, 0.0) for place in places)
    return begin(rows, HEADING_SD, outward, crop, camera)


@dataclass
class Walk:
    """A robot that steps to the left over plants, or, outward -1, to the right over their mirror image.

    wheels: what they report over what is true; hidden: from and to which way nothing is seen.
    """

    crop: CropProfile
    camera: Pinhole
    plants_m: np.ndarray
    outward: int = 1
    wheels: float = 1.0
    hidden_m: tuple[float, float] = (0.0, 0.0)
    change: Callable[[Crossing], Crossing] | None = None

    def steps(
        self, ways_m: Sequence[float], start: Crossing | None = None
    ) -> Iterator[tuple[float, Crossing]]:
        """The rows after each frame, taken at these ways from the old lane's middle."""
        crossing, last_m = start or begun(self.crop, self.camera, self.outward), float(ways_m[0])
        for way_m in ways_m:
            hidden = self.hidden_m[0] <= way_m < self.hidden_m[1]
            plants = self.plants_m[:0] if hidden else self.plants_m
            seen = centres(plants, way_m, self.crop, self.camera)
            seen = seen if self.outward > 0 else mirrored(seen, self.camera)
            moved = Travelled(0.0, self.outward * self.wheels * (way_m - last_m), 0.0)
            crossing = follow(crossing, seen, moved, self.crop, self.camera)
            crossing = self.change(crossing) if self.change else crossing
            last_m = way_m
            yield float(way_m), crossing

    def end(self, way_m: float, start_m: float = 0.0, start: Crossing | None = None) -> Crossing:
        """The rows after going there in steps of a frame."""
        *_, (_, crossing) = self.steps(np.arange(start_m, way_m + FRAME_M / 2, FRAME_M), start)
        return crossing


@pytest.fixture(scope="session")
def stepping() -> SimpleNamespace:
    """The tools of this file; a fixture, since test files cannot import it."""
    return SimpleNamespace(
        Walk=Walk, lanes=lanes, centres=centres, begun=begun, pitch_m=PITCH_M, frame_m=FRAME_M
    )
