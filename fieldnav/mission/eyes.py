"""The cameras as the loop sees them: the frames that are new, and how old the newest ones are."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from drivers.ports import Camera
from fieldnav.errors import DriverError
from fieldnav.faults import FaultKind, Reaction, Trouble
from fieldnav.messages import CameraName, Frame, Motion, Twist
from fieldnav.mission.frame_rate import FrameRate
from fieldnav.mission.picture_watch import PictureWatch
from fieldnav.mission.refusal import FUTURE_S, Sight
from fieldnav.odometry import Pose, Track
from fieldnav.pinhole import Pinhole
from fieldnav.settings.robot import Robot


@dataclass(slots=True)
class _Eye:
    """One camera: what it gave, what may be gone by, and what is wrong with the rest."""

    camera: Camera
    watch: PictureWatch
    rate: FrameRate
    given: Frame | None = None
    usable: Frame | None = None
    trouble: Trouble | None = None


class Eyes:
    """Keeps each camera's newest usable frame; a frame is handed on once, and never when it has become stale.

    What is black, white or frozen is no sight: the newest frame that can be gone by then grows old.
    """

    def __init__(
        self, cameras: Mapping[CameraName, Camera], pinholes: Mapping[CameraName, Pinhole], robot: Robot
    ) -> None:
        self._stale_s = robot.timeouts.frame_s
        self._eyes = {
            name: _Eye(
                camera,
                PictureWatch(pinholes[name], self._stale_s),
                FrameRate(robot.cameras.get(name).rate_hz),
            )
            for name, camera in cameras.items()
        }

    def look(
        self, now_s: float, guides: Iterable[CameraName], track: Track, heard: bool = True
    ) -> dict[CameraName, Frame]:
        """The frames, of those cameras that guide, that are new since the last look and can be gone by.

        track: where the robot was when; heard: whether the wheels have just said so. Raises DriverError for
        what does not mend by waiting: the wrong size, upside down, pictures that do not show where the robot
        is.
        """
        fresh = {}
        for name in guides:
            eye = self._eyes[name]
            frame = self._given(eye, now_s)
            if frame is None or frame is eye.given:
                continue
            eye.given = frame
            eye.rate.add(frame)
            if not -FUTURE_S <= now_s - frame.stamp_s <= self._stale_s:
                eye.usable, eye.trouble = frame, None  # its age speaks for itself
                continue
            eye.trouble = eye.watch.objection(frame, track, heard)
            if eye.trouble is None:
                eye.usable = fresh[name] = frame
        return fresh

    def _given(self, eye: _Eye, now_s: float) -> Frame | None:
        try:
            return eye.camera.latest(now_s)
        except DriverError as error:
            trouble = Trouble(error.fault, str(error))
            if trouble.reaction is not Reaction.HOLD:
                raise
            eye.trouble = trouble
            return None

    def forget(self) -> None:
        """Nothing that was seen before holds: the mission begins, or begins anew."""
        for eye in self._eyes.values():
            eye.watch.forget()

    def exposed(self, frames: Mapping[CameraName, Frame], track: Track) -> dict[CameraName, Pose]:
        """Where the robot was when each frame was taken, the camera's measured delay allowed for."""
        return {
            name: track.at(frame.stamp_s - self._eyes[name].watch.motion.delay_s)
            for name, frame in frames.items()
        }

    def sight(self, now_s: float, guides: Iterable[CameraName]) -> Sight:
        """The worst age of the newest frames that guide, and what is wrong with the cameras that give none.

        A stamp in the future, a negative age, is worse than any old one.
        """
        eyes = [self._eyes[name] for name in guides]
        trouble = next((eye.trouble for eye in eyes if eye.trouble), None)
        ages = [now_s - eye.usable.stamp_s + eye.watch.motion.delay_s for eye in eyes if eye.usable]
        if len(ages) < len(eyes):
            return Sight(None, trouble)
        youngest = min(ages, default=0.0)
        return Sight(youngest if youngest < -FUTURE_S else max(ages, default=0.0), trouble)

    def slowed(self, motion: Motion, guides: Iterable[CameraName]) -> Motion:
        """As fast as the slowest of the cameras that guide lets one see, and as shows how late its pictures
        are."""
        share, _ = self.slowness(guides)
        share *= min((self._eyes[name].watch.motion.speed_share for name in guides), default=1.0)
        twist = motion.twist
        slower = Twist(twist.vx_mps * share, twist.vy_mps * share, twist.yaw_rate_rps * share)
        return motion if share >= 1 else replace(motion, twist=slower)

    def slowness(self, guides: Iterable[CameraName]) -> tuple[float, Trouble | None]:
        """Share of the speed that the slowest camera's rate allows, and what is to be said of it."""
        share, slowest = min(
            ((self._eyes[name].rate.share, name) for name in guides),
            key=lambda pair: pair[0],
            default=(1.0, CameraName.FRONT),
        )
        if share >= 1:
            return 1.0, None
        return share, Trouble(
            FaultKind.CAMERA_SLOW, f"{slowest.value} camera: {self._eyes[slowest].rate.said}"
        )
