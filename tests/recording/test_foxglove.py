"""What Foxglove shows: pictures, what is drawn over them, the log, the place, how a camera sees."""

from datetime import UTC, datetime
from math import cos, pi, radians, sin

import numpy as np
import pytest
from foxglove_schemas_protobuf.CameraCalibration_pb2 import CameraCalibration
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.ImageAnnotations_pb2 import ImageAnnotations
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.PointsAnnotation_pb2 import PointsAnnotation
from foxglove_schemas_protobuf.PoseInFrame_pb2 import PoseInFrame

from fieldnav.messages import CameraName, Centres, RowLine
from fieldnav.pinhole import Pinhole
from fieldnav.recording.foxglove import Level, calibration, compressed_image, jpeg_of, log, pose
from fieldnav.recording.foxglove_overlay import overlay

UTC_NOW = datetime(2026, 5, 1, 8, 30, 1, 250000, tzinfo=UTC)
PINHOLE = Pinhole(1280, 720, 930.0, 1.0, radians(65), 0.75)
SIZE_PX = (1280, 720)
ROWS = [RowLine(300, 200, 0.9), RowLine(640, 640, 0.8), RowLine(980, 1080, 0.0)]
CENTRES = Centres(np.array([[10.0, 20.0], [30.0, 40.0]]), np.ones(2), np.zeros(2), np.ones(2))


def segments(annotation: PointsAnnotation) -> list[tuple[float, float]]:
    return [(point.x, point.y) for point in annotation.points]


def test_a_picture_says_whose_it_is_and_when() -> None:
    image = CompressedImage.FromString(compressed_image(CameraName.REAR, UTC_NOW, b"\xff\xd8"))

    assert (image.frame_id, image.format, image.data) == ("rear", "jpeg", b"\xff\xd8")
    assert image.timestamp.ToDatetime(UTC) == UTC_NOW


def test_a_picture_gives_its_jpeg_back() -> None:
    assert jpeg_of(compressed_image(CameraName.FRONT, UTC_NOW, b"\xff\xd8")) == b"\xff\xd8"


def test_rows_are_lines_from_the_upper_to_the_lower_edge_and_held_ones_are_dimmer() -> None:
    drawn = ImageAnnotations.FromString(overlay(UTC_NOW, SIZE_PX, ROWS))

    seen, held = drawn.points
    assert {seen.type, held.type} == {PointsAnnotation.LINE_LIST}
    assert segments(seen) == [(300.5, 0.5), (200.5, 719.5), (640.5, 0.5), (640.5, 719.5)]
    assert segments(held) == [(980.5, 0.5), (1080.5, 719.5)]
    assert held.outline_color.a < seen.outline_color.a == 1.0


def test_rows_end_at_a_horizon_that_is_in_view() -> None:
    rows = [RowLine(1280, 0, 0.9)]

    drawn = ImageAnnotations.FromString(overlay(UTC_NOW, SIZE_PX, rows, None, rows[0], sky_px=179.75))

    for lines in drawn.points:
        assert segments(lines) == [(960.5, 180.25), (0.5, 719.5)]


def test_plants_are_points_and_the_average_line_is_the_thickest() -> None:
    drawn = ImageAnnotations.FromString(overlay(UTC_NOW, SIZE_PX, ROWS, CENTRES, RowLine(650, 630)))

    seen, _, feature, plants = drawn.points
    assert (plants.type, segments(plants)) == (PointsAnnotation.POINTS, [(10.5, 20.5), (30.5, 40.5)])
    assert segments(feature) == [(650.5, 0.5), (630.5, 719.5)]
    assert feature.thickness == 2 * seen.thickness


def test_the_caption_stands_line_by_line_within_the_picture() -> None:
    drawn = ImageAnnotations.FromString(overlay(UTC_NOW, SIZE_PX, [], caption=["Tracking", "lane 1"]))

    assert not drawn.points
    assert [text.text for text in drawn.texts] == ["Tracking", "lane 1"]
    first, second = (text.position.y for text in drawn.texts)
    assert 0 < first < second - drawn.texts[0].font_size < second < SIZE_PX[1]


@pytest.mark.parametrize("level", Level)
def test_a_line_of_the_log_has_its_level(level: Level) -> None:
    line = Log.FromString(log(UTC_NOW, level, "mission", "rows lost"))

    assert (Log.Level.Name(line.level), line.name, line.message) == (level.name, "mission", "rows lost")


def test_the_calibration_projects_as_the_pinhole_does() -> None:
    said = CameraCalibration.FromString(calibration(CameraName.FRONT, UTC_NOW, PINHOLE))
    ahead_m, left_m = 1.4, 0.2
    along_m, tilt = ahead_m - PINHOLE.forward_m, PINHOLE.tilt_rad
    right, down, depth = (
        -left_m,
        PINHOLE.height_m * cos(tilt) - along_m * sin(tilt),
        along_m * cos(tilt) + PINHOLE.height_m * sin(tilt),
    )

    u, v, w = np.reshape(said.P, (3, 4)) @ (right, down, depth, 1)

    assert (said.frame_id, said.width, said.height) == ("front", 1280, 720)
    assert np.reshape(said.K, (3, 3)) == pytest.approx(np.reshape(said.P, (3, 4))[:, :3])
    assert (u / w, v / w) == pytest.approx(tuple(PINHOLE.to_image(np.array([ahead_m, left_m]))))


def test_the_pose_turns_about_the_vertical() -> None:
    said = PoseInFrame.FromString(pose(UTC_NOW, 3.0, -1.0, pi / 2))

    turn = said.pose.orientation
    assert (said.pose.position.x, said.pose.position.y, said.pose.position.z) == (3.0, -1.0, 0.0)
    assert (turn.x, turn.y, turn.z, turn.w) == pytest.approx((0, 0, sin(pi / 4), cos(pi / 4)))
