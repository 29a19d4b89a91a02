"""Files that are one recording, one after the other: the MCAP files of a bag of ROS 2."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from pathlib import Path

import yaml

from fieldnav.replay.foreign.container import Container, Told

METADATA = "metadata.yaml"
"""What makes a folder a bag of ROS 2."""
SUFFIX = ".mcap"
INFORMATION, UNCOMPRESSED = "rosbag2_bagfile_information", ("", "none")


class Joined:
    """The Container over others."""

    def __init__(self, name: str, parts: Sequence[Container]) -> None:
        self._name, self._parts = name, parts

    @property
    def name(self) -> str:
        return self._name

    @property
    def topics(self) -> Mapping[str, str]:
        return {topic: kind for part in self._parts for topic, kind in part.topics.items()}

    @property
    def counts(self) -> Mapping[str, int]:
        return sum((Counter(part.counts) for part in self._parts), Counter())

    @property
    def seconds(self) -> float:
        return sum(part.seconds for part in self._parts)

    def read(self, topic: str) -> Iterator[Told]:
        return chain.from_iterable(part.read(topic) for part in self._parts if topic in part.topics)


def mcap_files(folder: Path) -> list[Path]:
    """The MCAP files of a bag of ROS 2 in order; none where it is another bag, or compressed as a whole.

    A recorder that was killed leaves no metadata; then they are all that a folder holds. What is wrong with
    its metadata, rosbags tells.
    """
    try:
        if not (folder / METADATA).exists():
            files = [each for each in folder.iterdir() if each.is_file()] if folder.is_dir() else []
            alone = all(each.suffix == SUFFIX for each in files)
            return sorted(files, key=lambda each: (len(each.name), each.name)) if alone else []
        told = yaml.safe_load((folder / METADATA).read_text())[INFORMATION]
        whole = told.get("compression_mode", "").lower() in UNCOMPRESSED
        if told["storage_identifier"] != "mcap" or not whole:
            return []
        return [folder / Path(each).name for each in told["relative_file_paths"]]
    except (OSError, ValueError, yaml.YAMLError, KeyError, TypeError, AttributeError):
        return []
