"""Which topics hold the pictures of which camera."""

from collections.abc import Mapping

from fieldnav.errors import SettingsError
from fieldnav.messages import CameraName
from fieldnav.replay.foreign.container import IMAGES, Container

MAX_LISTED = 20
"""Topics that one line names."""


def image_topics(
    container: Container, named: Mapping[CameraName, str], leading: CameraName
) -> dict[CameraName, str]:
    """The topic of each camera: as named, or the only one there is, for the camera that leads.

    Raises SettingsError, with the topics that hold pictures.
    """
    there, allowed = picture_topics(container), _allowed(container)
    for camera, topic in named.items():
        if topic not in there:
            what = f"holds {container.topics[topic]}" if topic in container.topics else "is not there"
            raise SettingsError(f"{container.name}: --{camera.value} {topic}: {what}; {allowed}")
    if len(named) == len(CameraName) and len(set(named.values())) == 1:
        raise SettingsError(f"{container.name}: --front and --rear name the same topic; {allowed}")
    if named and leading not in named:
        raise SettingsError(
            f"{container.name}: --{leading.value}: is not given, and that camera leads; {allowed}; "
            "or the other --direction"
        )
    if named:
        return dict(named)
    if len(there) == 1:
        return {leading: next(iter(there))}
    raise SettingsError(f"{container.name}: --front, --rear: no topic is named; {allowed}")


def picture_topics(container: Container) -> dict[str, str]:
    """The topics that hold pictures which can be read, with their types."""
    return {topic: kind for topic, kind in container.topics.items() if kind in IMAGES}


def _allowed(container: Container) -> str:
    if there := picture_topics(container):
        return f"allowed are {_listed(there)}"
    holds = f"it holds {_listed(container.topics)}" if container.topics else "it holds no topic"
    return f"it holds no topic with pictures; allowed are {', '.join(IMAGES)}; {holds}"


def _listed(topics: Mapping[str, str]) -> str:
    shown = [f"{topic} ({kind})" for topic, kind in sorted(topics.items())]
    more = [f"{len(shown) - MAX_LISTED} more"] if len(shown) > MAX_LISTED else []
    return ", ".join([*shown[:MAX_LISTED], *more])
