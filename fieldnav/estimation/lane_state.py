"""What is known of the robot against its lane."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LaneState:
    """The robot's centre against the middle of its lane, looking in the direction of travel.

    offset_m: how far left of the lane's middle; heading_rad: how far turned left of its direction;
    curvature_per_m: of the lane at the robot, positive to the left; offset_sd_m, heading_sd_rad: standard
    deviations; sideslip: metres that the robot is pushed to the left for each metre driven, and yaw_per_m how
    much it turns to the left, both beyond what its wheels report.
    """

    offset_m: float
    heading_rad: float
    curvature_per_m: float
    offset_sd_m: float
    heading_sd_rad: float
    sideslip: float
    yaw_per_m: float
