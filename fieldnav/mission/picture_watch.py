"""Whether a camera's pictures can be gone by: lit, alive, in colour, and showing what must be in view."""

from math import ceil

import cv2
import numpy as np
from numpy.typing import NDArray

from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind, Reaction, Trouble
from fieldnav.messages import Frame
from fieldnav.mission.motion_monitor import MotionMonitor, View
from fieldnav.mission.repeated_pictures import RepeatedPictures
from fieldnav.odometry import Pose, Track
from fieldnav.perception.ground_view import GroundView
from fieldnav.perception.pose.picture_quality import BLACK, WHITE, detail, same, same_share
from fieldnav.perception.sidestep.wheel_motion import travelled
from fieldnav.pinhole import Pinhole

EVERY_PX = 8
"""Pixels of every so many rows and columns are looked at: 14,000 of them, whose noise never comes twice."""
FROZEN_M = 0.02
"""Driven under one and the same picture; a plant then moves by ten pixels."""
STILL_SHARE = 0.9
"""Of the pixels that stay exactly as they were in the same picture, in which a clock may run: noise alone
changes more of them from one picture to the next."""
NEARLY_FROZEN_M = 0.05
"""Driven under such a picture; two that are so much alike may be chance, three are not."""
FROZEN_S = 5.0
"""The same picture to its last pixel for so long is none of a standing robot's either: leaves and light
move."""
COLOUR_LEVELS, COLOURED_SHARE = 6, 0.05
"""Grey levels between a pixel's channels, and the share of pixels that have more: the most colourful
twentieth of dull soil has 11, a camera's night mode 0, JPEG's rounding 2."""
DETAIL = 0.8
"""Grey levels; the barest soil has 5 drawn, 7 in photographs, flat soil under noise alone 1.1, mud 0.5."""
LEFT_SHARE = 0.2
"""Of the plants that must be in view; wind and shaking leave more than half."""
REMEMBERED_S = 4.0
"""Longer than a fault is held for: afterwards a person may have hung the camera anew."""
COMPARED_M, COMPARED_S = 0.02, 0.13
"""Pictures are compared once the robot has moved so far, or two frames later."""


class PictureWatch:
    """Looks at each frame of one camera before anything is gone by it."""

    def __init__(self, camera: Pinhole, max_delay_s: float) -> None:
        """max_delay_s: by which pictures may be older than their stamps."""
        self._camera = camera
        self._view = GroundView(camera)
        self.motion = MotionMonitor(self._view, max_delay_s)
        self._repeated = RepeatedPictures()
        self._before: View | None = None
        self._sample = self._image = np.empty(0, np.uint8)
        self._changed_s = 0.0
        self._changed_at = Pose()

    def objection(self, frame: Frame, track: Track, heard: bool = True) -> Trouble | None:
        """Why a frame must not guide; track: where the robot was when, and whether the wheels have just said
        so.

        Raises DriverError for what no waiting mends: a picture of the wrong size, or not of where the robot
        is.
        """
        self._check_size(frame)
        sample = np.ascontiguousarray(frame.image[::EVERY_PX, ::EVERY_PX])
        pose = track.at(frame.stamp_s)
        ground = sample[ceil(self._camera.top_px / EVERY_PX) :]
        found = self._unlit(frame, float(ground.mean())) or self._frozen(frame, sample, pose)
        found = found or self._empty(frame, ground) or self._shown_before(frame, sample, pose)
        if not heard:
            self._before = None  # what the wheels do is not known: nothing can be held against it
            self.motion.interrupted()
            return found
        found = found or self._compared(frame, pose, track)
        if found is not None and found.reaction is not Reaction.HOLD:
            raise DriverError(found.said, found.fault)
        return found

    def forget(self) -> None:
        """Begin anew: a person may have moved the robot or hung the camera otherwise."""
        self._repeated, self._before = RepeatedPictures(), None
        self.motion.forget()

    def _check_size(self, frame: Frame) -> None:
        height, width = frame.image.shape[:2]
        if (width, height) != (self._camera.width_px, self._camera.height_px):
            wanted = f"{self._camera.width_px}x{self._camera.height_px}"
            raise DriverError(
                f"{frame.camera.value} camera gives {width}x{height}, its file says {wanted}",
                FaultKind.CAMERA_SIZE,
            )

    def _unlit(self, frame: Frame, brightness: float) -> Trouble | None:
        name = f"{frame.camera.value} camera: brightness {brightness:.0f} of 255"
        if brightness < BLACK:
            return Trouble(FaultKind.CAMERA_BLACK, f"{name}, limit {BLACK:.0f}")
        if brightness > WHITE:
            return Trouble(FaultKind.CAMERA_WHITE, f"{name}, limit {WHITE:.0f}")
        return None

    def _frozen(self, frame: Frame, sample: NDArray[np.uint8], pose: Pose) -> Trouble | None:
        still = same_share(sample, self._sample)
        if still < STILL_SHARE:
            self._sample, self._image = sample, frame.image
            self._changed_s, self._changed_at = frame.stamp_s, pose
            return None
        driven_m = self._changed_at.distance_m(pose)
        same_s = frame.stamp_s - self._changed_s
        far_m = FROZEN_M if still == 1 else NEARLY_FROZEN_M
        if driven_m <= far_m and not (same_s > FROZEN_S and same(frame.image, self._image)):
            return None
        but = f", but for {1 - still:.0%} of it," if still < 1 else ""
        said = f"{frame.camera.value} camera: the same picture{but} for {same_s:.2f} s and {driven_m:.2f} m"
        return Trouble(FaultKind.CAMERA_FROZEN, said)

    def _shown_before(self, frame: Frame, sample: NDArray[np.uint8], pose: Pose) -> Trouble | None:
        age_s = self._repeated.age_s(sample, frame.stamp_s, pose)
        if age_s is None:
            return None
        said = f"{frame.camera.value} camera: it shows pictures again that it showed {age_s:.1f} s ago"
        return Trouble(FaultKind.CAMERA_PAST, said)

    def _empty(self, frame: Frame, sample: NDArray[np.uint8]) -> Trouble | None:
        """Crop is told from soil by its colour: a grey picture shows no crop, and that is no sign of its
        end."""
        name = f"{frame.camera.value} camera"
        seen = detail(frame.image[ceil(self._camera.top_px) :])
        if seen < DETAIL:
            said = f"{name}: nothing can be told apart in it, detail {seen:.1f}, limit {DETAIL:.1f}"
            return Trouble(FaultKind.CAMERA_BLIND, said)
        blue, green, red = cv2.split(sample)
        colour = cv2.subtract(cv2.max(cv2.max(blue, green), red), cv2.min(cv2.min(blue, green), red))
        coloured = np.count_nonzero(np.asarray(colour) > COLOUR_LEVELS) / colour.size
        if coloured >= COLOURED_SHARE:
            return None
        said = f"{name}: {coloured:.0%} of the picture has a colour, limit {COLOURED_SHARE:.0%}"
        return Trouble(FaultKind.CAMERA_BLIND, said)

    def _compared(self, frame: Frame, pose: Pose, track: Track) -> Trouble | None:
        """Hold the picture against an earlier one, by what the wheels say of the way between."""
        before = self._before
        if before is not None and frame.stamp_s - before.stamp_s > REMEMBERED_S:
            before = self._before = None
            self.motion.paused()
        if before is not None:
            moved_m = track.at(before.stamp_s).distance_m(pose)
            # Where pitch moves the ground by decimetres, a picture is held against the very next one.
            soon = not self._view.oblique and frame.stamp_s - before.stamp_s < COMPARED_S
            if moved_m < COMPARED_M and soon:
                return None
        now = View(self._view.look(frame.image), frame.stamp_s)
        if before is None:
            self._before = now
            return None
        found = self._vanished(frame, before, now, track)
        if found is not None:
            return found  # what was in view before stays what is looked for
        self._before = now
        return self.motion.trouble(frame.camera, before, now, track)

    def _vanished(self, frame: Frame, before: View, now: View, track: Track) -> Trouble | None:
        """Plants that were in view, and by the wheels' word must still be, do not end like a row does."""
        moved = travelled(track.at(before.stamp_s), track.at(now.stamp_s), frame.camera)
        left_m = moved.left_m + moved.turn_rad * self._view.middle_m
        left = self._view.plants_left(before.ground, now.ground, moved.ahead_m, left_m)
        if left is None or left >= LEFT_SHARE:
            return None
        said = (
            f"{frame.camera.value} camera: {left:.0%} of the plants that must be in view are, "
            f"limit {LEFT_SHARE:.0%}"
        )
        return Trouble(FaultKind.CAMERA_BLIND, said)
