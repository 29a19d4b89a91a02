"""Other settings may not want pictures of another size than those that were recorded."""

from fieldnav.errors import SettingsError
from fieldnav.journal.resolved import Settings
from fieldnav.messages import CameraName


def check_pictures(then: Settings, now: Settings) -> None:
    """Raises SettingsError for cameras whose pictures would have another size than those recorded."""
    for name in CameraName:
        recorded, asked = (settings.robot.cameras.get(name) for settings in (then, now))
        for key in ("width_px", "height_px"):
            value, allowed = getattr(asked, key), getattr(recorded, key)
            if value != allowed:
                raise SettingsError(
                    f"robot.cameras.{name.value}.{key}: {value}; allowed is {allowed}, as it was recorded"
                )
