"""Where the rows say that a camera looks."""

from dataclasses import replace
from math import radians

from fieldnav.preflight.finding import Verdict


def test_a_camera_upside_down_fails_by_how_its_rows_converge(bench):
    bench.show("front", lambda seed: bench.lane(seed)[::-1, ::-1])

    found = bench.check(bench.crop)

    assert found["front camera upright"].verdict is Verdict.FAIL
    assert found["front camera upright"].figure == "rows converge towards the bottom"
    assert found["rear camera upright"].verdict is Verdict.OK
    assert "front camera tilt" not in found, "the pose of such a picture means nothing"


def test_a_camera_knocked_far_off_is_warned_of_with_value_file_and_limit(bench):
    knocked = replace(bench.camera, tilt_rad=radians(80))
    bench.show("front", lambda seed: bench.lane(seed, knocked))

    found = bench.check(bench.crop)

    tilt = found["front camera tilt"]
    assert tilt.verdict is Verdict.WARNING
    assert "65 in the file, limit 4" in tilt.figure
    assert float(tilt.figure.split()[0]) > 72
    assert found["front camera height"].verdict is Verdict.OK
    assert found["rear camera tilt"].verdict is Verdict.OK


def test_over_bare_soil_neither_pose_nor_rows_can_be_told(bench):
    bench.show("front", lambda seed: bench.grained(bench.soil, seed))

    found = bench.check(bench.crop)

    assert found["front camera pose"].verdict is Verdict.WARNING
    assert "no two rows seen" in found["front camera pose"].figure
    assert found["front camera rows"].verdict is Verdict.WARNING
    assert found["front camera rows"].figure == "0 seen; the profile has 3 to a lane"
    assert "front camera upright" not in found
