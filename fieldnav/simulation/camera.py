"""The simulated camera: the Camera port with the latency, losses and calibration errors of a real one.

Frames are drawn only when they are asked for; what was to be seen is kept from the moment of exposure, so a
frame does not depend on whether others were drawn.
"""

from collections import deque
from dataclasses import dataclass
from math import cos, pi, radians, sin
from typing import Protocol

import numpy as np

from fieldnav.messages import CameraName, Frame, Image
from fieldnav.settings.camera import CameraSettings
from fieldnav.simulation.renderer import View
from fieldnav.simulation.rendering.view import FARTHEST_M
from fieldnav.simulation.sensor import Sensor
from fieldnav.simulation.shaking import rotation
from fieldnav.simulation.streams import Stream, random_stream
from fieldnav.simulation.world import Motion, World

BEYOND = 1.6
"""Times the ground that counts, up to which plants are drawn: a camera that hangs 1.5 degrees too high and
pitches by two more looks so far."""
KEPT = 16
"""Exposures kept until drawn; the newest is always among them."""


@dataclass(frozen=True, slots=True)
class _Exposure:
    sequence: int
    stamp_s: float
    view: View
    motion_px: tuple[float, float]


class Renderer(Protocol):
    """Draws a field: as it looks, or as a sketch."""

    def render(self, view: View, time_s: float) -> Image:
        """The picture, shape (height, width, 3), blue, green, red."""
        ...


class SimulatedCamera:
    """Looks at the world from its place on the robot."""

    def __init__(self, name: CameraName, world: World, renderer: Renderer) -> None:
        self._name, self._world, self._renderer = name, world, renderer
        self._settings: CameraSettings = world.robot.cameras.get(name)
        self._pinhole = self._settings.pinhole()
        errors, place = world.field.camera_errors, list(CameraName).index(name)
        drawn = random_stream(world.field.seed, Stream.CALIBRATION, place).uniform(-1, 1, 3)
        self._tilt_rad = self._pinhole.tilt_rad + radians(errors.tilt_error_deg) * float(drawn[0])
        self._height_m = self._pinhole.height_m + errors.height_error_m * float(drawn[1])
        self._focal_px = self._pinhole.focal_px * (1 + errors.focal_error * float(drawn[2]))
        yaw = float(random_stream(world.field.seed, Stream.CAMERA_YAW, place).uniform(-1, 1))
        self._yaw_rad = radians(errors.yaw_error_deg) * yaw * (-1 if world.field.mirrored else 1)
        self._losses = random_stream(world.field.seed, Stream.LOST_FRAMES, place)
        self._farthest_m = FARTHEST_M
        if self._pinhole.top_px:
            self._farthest_m = max(FARTHEST_M, BEYOND * (self._pinhole.view_m[1] - self._pinhole.forward_m))
        size_px = (self._pinhole.width_px, self._pinhole.height_px)
        self._sensor = Sensor(errors, *size_px, world.field.seed + place, world.field.mirrored)
        # The two cameras do not expose at the same moment.
        self._due_s = place / len(CameraName) / self._settings.rate_hz
        self._sequence = 0
        self._waiting: deque[_Exposure] = deque(maxlen=KEPT)
        self._frame: Frame | None = None
        world.after_step.append(self._expose)

    def _expose(self) -> None:
        """Take a picture of this moment if one is due."""
        now = self._world.now
        if now.stamp_s < self._due_s:
            return
        self._due_s += 1 / self._settings.rate_hz
        self._sequence += 1
        if self._losses.random() >= self._world.field.camera_errors.lost_frames:
            self._waiting.append(_Exposure(self._sequence, now.stamp_s, self.view(now), self._smear_px(now)))

    def latest(self, now_s: float) -> Frame | None:
        """The newest picture that has arrived."""
        arrived: _Exposure | None = None
        while self._waiting and self._waiting[0].stamp_s + self._world.field.camera_errors.latency_s <= now_s:
            arrived = self._waiting.popleft()
        if arrived:
            plain = self._renderer.render(arrived.view, arrived.stamp_s)
            image = self._sensor.expose(plain, arrived.sequence, arrived.motion_px)
            self._frame = Frame(self._name, arrived.sequence, arrived.stamp_s, image)
        return self._frame

    def close(self) -> None:
        """Nothing to give back."""

    def view(self, now: Motion) -> View:
        """What the camera, where it truly hangs, sees of the world at a moment."""
        looking = 1 if self._name is CameraName.FRONT else -1
        heading = now.pose.heading_rad
        gaze = heading + self._yaw_rad + (0.0 if looking > 0 else pi)
        ahead_m = looking * self._settings.distance_m
        position = np.array(
            [
                now.pose.x_m + ahead_m * cos(heading),
                now.pose.y_m + ahead_m * sin(heading),
                self._height_m + now.attitude.height_m - ahead_m * sin(now.attitude.pitch_rad),
            ]
        )
        # Seen from the rear camera, rolling and pitching go the other way.
        turned = rotation(now.attitude, looking, gaze, self._tilt_rad)
        size_px = (self._pinhole.width_px, self._pinhole.height_px)
        return View(*size_px, self._focal_px, position, turned, self._farthest_m)

    def _smear_px(self, now: Motion) -> tuple[float, float]:
        """How far the ground at the image's centre moves during the exposure."""
        looking = 1 if self._name is CameraName.FRONT else -1
        across_px = float(self._pinhole.pixels_per_metre(self._pinhole.centre_y_px))
        along_px = across_px * sin(self._tilt_rad)
        exposed = looking * self._world.field.camera_errors.exposure_s
        sideways_mps = now.twist.vy_mps + now.twist.yaw_rate_rps * looking * self._settings.distance_m
        return sideways_mps * across_px * exposed, now.twist.vx_mps * along_px * exposed
