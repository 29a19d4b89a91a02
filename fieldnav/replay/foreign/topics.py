"""Which topics hold the pictures of which camera."""

from collections.abc import Mapping

from fieldnav.errors import SettingsError
from fieldnav.messages import CameraName
from fieldnav.replay.foreign.container import IMAGES, Container


def image_topics(
    container: Container, named: Mapping[CameraName, str], leading: CameraName
) -> dict[CameraName, str]:
    """The topic of each camera: as named, or the only one there is, for the camera that leads.

    Raises SettingsError, with the topics that hold pictures.
    """
    there = {topic: kind for topic, kind in container.topics.items() if kind in IMAGES}
    for camera, topic in named.items():
        if topic not in there:
            what = f"holds {container.topics[topic]}" if topic in container.topics else "is not there"
            raise SettingsError(f"{container.name}: --{camera.value} {topic}: {what}; {_allowed(there)}")
    if len(named) == len(CameraName) and len(set(named.values())) == 1:
        raise SettingsError(f"{container.name}: --front and --rear name the same topic; {_allowed(there)}")
    if named and leading not in named:
        raise SettingsError(
            f"{container.name}: --{leading.value}: is not given, and that camera leads; {_allowed(there)}; "
            "or the other --direction"
        )
    if named:
        return dict(named)
    if len(there) == 1:
        return {leading: next(iter(there))}
    raise SettingsError(f"{container.name}: --front, --rear: no topic is named; {_allowed(there)}")


def _allowed(there: Mapping[str, str]) -> str:
    if not there:
        return f"it holds no topic with pictures; allowed are {', '.join(IMAGES)}"
    return f"allowed are {', '.join(f'{topic} ({kind})' for topic, kind in sorted(there.items()))}"
