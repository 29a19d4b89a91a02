"""Bags of ROS: only the topics that are asked for must be readable."""

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.rosbag1 import Writer as Bag1Writer
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Bag2Writer
from rosbags.typesys import Stores, get_typestore

from fieldnav.errors import SettingsError
from fieldnav.replay.foreign.ros_bag import RosBag

TOPIC, KIND, COUNT = "/cam", "sensor_msgs/msg/CompressedImage", 5
BEGUN_NS, NS_PER_S = 1_700_000_000_000_000_000, 1_000_000_000
CHECKSUM, WRONG = "0123456789abcdef0123456789abcdef", "f" * 32
OTHERS = [
    ("an empty definition", "lidar_msgs/msg/Scan", "", CHECKSUM),
    ("a placeholder", "lidar_msgs/msg/Scan", "# see lidar_msgs/Definition\nDefinition unknown\n", CHECKSUM),
    ("a nested type that lacks", "wheel_msgs/msg/Wheels", "wheel_msgs/Part[] parts\n", CHECKSUM),
    ("no grammar", "wheel_msgs/msg/Wheels", "float32[ ] = ; {", CHECKSUM),
    ("another checksum", "wheel_msgs/msg/Rpm", "float32 rpm\n", CHECKSUM),
    ("any checksum", "topic_tools/msg/ShapeShifter", "", "*"),
]


def message(store: Any, number: int) -> Any:
    types = store.types
    header = types["std_msgs/msg/Header"]
    rest = {"seq": number} if "seq" in header.__dataclass_fields__ else {}
    stamp = types["builtin_interfaces/msg/Time"](sec=BEGUN_NS // NS_PER_S + number, nanosec=0)
    data = np.full(9, number, np.uint8)
    return types[KIND](header=header(stamp=stamp, frame_id="cam", **rest), format="jpeg", data=data)


def bag1(folder: Path, other: tuple[str, str, str, str], own: dict[str, str] | None = None) -> RosBag:
    """A bag of ROS 1 with another topic beside; own: definition and checksum of the pictures' type."""
    path, store = folder / "drive.bag", get_typestore(Stores.ROS1_NOETIC)
    _, kind, definition, checksum = other
    with Bag1Writer(path) as bag:
        cam = bag.add_connection(TOPIC, KIND, **(own or {"typestore": store}))
        beside = bag.add_connection("/other", kind, msgdef=definition, md5sum=checksum)
        for number in range(COUNT):
            at_ns = BEGUN_NS + number * NS_PER_S
            bag.write(beside, at_ns, b"\xff" * 7)
            bag.write(cam, at_ns, store.serialize_ros1(message(store, number), KIND))
    return RosBag(path)


def found(bag: RosBag) -> list[int]:
    return [int(each.content.data[0]) for each in bag.read(TOPIC)]


@pytest.mark.parametrize("other", OTHERS, ids=[name for name, *_ in OTHERS])
def test_in_ros_1_a_topic_beside_may_be_broken(other: tuple[str, str, str, str], tmp_path: Path) -> None:
    bag = bag1(tmp_path, other)

    assert found(bag) == list(range(COUNT))
    assert bag.topics[TOPIC] == KIND and bag.counts == {TOPIC: COUNT, "/other": COUNT}


@pytest.mark.parametrize("storage", list(StoragePlugin))
@pytest.mark.parametrize("other", OTHERS[:4], ids=[name for name, *_ in OTHERS[:4]])
def test_in_ros_2_a_topic_beside_may_be_broken(
    other: tuple[str, str, str, str], storage: StoragePlugin, tmp_path: Path
) -> None:
    path, store = tmp_path / "drive", get_typestore(Stores.ROS2_HUMBLE)
    _, kind, definition, _ = other
    with Bag2Writer(path, version=9, storage_plugin=storage) as bag:
        cam = bag.add_connection(TOPIC, KIND, typestore=store)
        beside = bag.add_connection("/other", kind, msgdef=definition, rihs01=f"RIHS01_{CHECKSUM * 2}")
        for number in range(COUNT):
            bag.write(beside, BEGUN_NS + number, b"\xff" * 7)
            bag.write(cam, BEGUN_NS + number, store.serialize_cdr(message(store, number), KIND))

    assert found(RosBag(path)) == list(range(COUNT))


@pytest.mark.parametrize("definition", ["", "nothing that is a definition [", "none/Such thing\n"])
def test_ros_own_definition_stands_for_one_of_the_pictures_that_lacks(
    definition: str, tmp_path: Path
) -> None:
    usual = get_typestore(Stores.ROS1_NOETIC).generate_msgdef(KIND)[1]

    bag = bag1(tmp_path, OTHERS[0], {"msgdef": definition, "md5sum": usual})

    assert found(bag) == list(range(COUNT))


def test_pictures_of_another_type_by_its_checksum_are_refused(tmp_path: Path) -> None:
    bag = bag1(tmp_path, OTHERS[0], {"msgdef": "", "md5sum": WRONG})

    with pytest.raises(
        SettingsError, match=r"drive\.bag: the definition of .* cannot be read, and its checksum"
    ):
        found(bag)


def test_a_database_without_its_metadata_is_read(tmp_path: Path) -> None:
    path, store = tmp_path / "drive", get_typestore(Stores.ROS2_HUMBLE)
    with Bag2Writer(path, version=9) as bag:
        cam = bag.add_connection(TOPIC, KIND, typestore=store)
        for number in range(COUNT):
            bag.write(cam, BEGUN_NS + number, store.serialize_cdr(message(store, number), KIND))
    alone = shutil.move(path / "drive.db3", tmp_path / "alone.db3")

    assert found(RosBag(Path(alone))) == list(range(COUNT))


def test_a_bag_of_no_messages_holds_no_topic(tmp_path: Path) -> None:
    with Bag1Writer(tmp_path / "none.bag"):
        pass

    bag = RosBag(tmp_path / "none.bag")

    assert bag.topics == {} and bag.seconds == 0
