"""The rosbags package, which only those need who replay what ROS has recorded."""

from types import ModuleType

from fieldnav.errors import SettingsError


def rosbags(name: str) -> tuple[ModuleType, ModuleType]:
    """Its readers and its types. Raises SettingsError where it is not installed; name: of what needs it."""
    try:
        from rosbags import highlevel, typesys  # noqa: PLC0415 - an extra, that not everybody installs
    except ImportError as error:
        raise SettingsError(
            f"{name}: holds messages of ROS, which the package rosbags reads; it is not installed: "
            "pip install 'fieldnav[bags]'"
        ) from error
    return highlevel, typesys
