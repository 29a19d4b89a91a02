"""Image-based visual servoing along the crop rows (paper III-B).

The feature is the lane's average line, [a, H/2, theta]; the law drives it to [0, H/2, 0] by the yaw rate
alone while the robot travels at a given speed. The interaction matrix is that of Cherubini, Chaumette and
Oriolo, "Visual servoing for path reaching with nonholonomic robots" (Robotica 29, 2011), in its row form: the
line is observed where it crosses a fixed image row. X and Y are pixels from the image's centre over the focal
length, theta is the line's angle from the image's vertical, positive clockwise.
"""

from math import cos, sin, tan

import numpy as np

from fieldnav.messages import Floats
from fieldnav.perception.tracking import Feature
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import Servoing


def interaction_matrix(x: float, y: float, theta_rad: float, camera: Pinhole) -> Floats:
    """Derivatives of [x, theta] by the camera's own velocity [vx vy vz wx wy wz]; shape (2, 6)."""
    rho, height_m = camera.tilt_rad, camera.height_m
    slope = -tan(theta_rad)  # of the line x = axis + slope * y
    axis = x - slope * y
    # Every point of the line obeys the interaction matrix of a point on the ground plane; what remains after
    # the points' sliding along the line is the movement of its axis and of its slope.
    translation = np.array([-1.0, slope, axis]) / height_m
    axis_rate = np.array([*(sin(rho) * translation), -slope, -1 - axis**2, axis * slope])
    slope_rate = np.array([*(cos(rho) * translation), axis, -axis * slope, 1 + slope**2])
    return np.stack([axis_rate + y * slope_rate, -(cos(theta_rad) ** 2) * slope_rate])


def robot_to_camera(camera: Pinhole) -> Floats:
    """Camera velocity by the robot's [speed in the camera's looking direction, yaw rate]; shape (6, 2)."""
    rho = camera.tilt_rad
    speed = [0.0, -sin(rho), cos(rho), 0.0, 0.0, 0.0]
    yaw = [-camera.forward_m, 0.0, 0.0, 0.0, -cos(rho), -sin(rho)]
    return np.array([speed, yaw]).T


def gains(camera: Pinhole, speed_mps: float, servoing: Servoing) -> Floats:
    """The law's two gains [lambda_x, lambda_theta] in 1/s, placed for the wanted convergence; shape (2,).

    Near the goal the robot's distance e to the left of the lane and its heading d obey e' = v d and d' = w,
    and the feature is x = k e + Jx d, theta = -c e + Jt d with the Jacobian J of the yaw rate. Asking for
    w = -k_e e - k_d d with poles of natural length `convergence_m` gives two linear equations for the gains.
    With the trailing camera the speed is negative and the signs come out as they must.
    """
    y = camera.centre_y_px / camera.focal_px
    natural_rps = abs(speed_mps) / servoing.convergence_m
    wanted = np.array([natural_rps**2 / speed_mps, 2 * servoing.damping * natural_rps])
    by_speed, by_yaw = (interaction_matrix(0.0, y, 0.0, camera) @ robot_to_camera(camera)).T
    assert not by_speed.any(), "on the lane, travelling straight moves nothing"
    rho = camera.tilt_rad
    along = np.array([sin(rho) + y * cos(rho), -cos(rho)]) / camera.height_m
    strength = by_yaw @ by_yaw
    feedforward = speed_mps * (by_yaw @ along)
    equations = np.stack([by_yaw * along, by_yaw * by_yaw])
    return np.linalg.solve(equations, wanted * strength - np.array([0.0, feedforward]))


def yaw_rate(feature: Feature, camera: Pinhole, speed_mps: float, servoing: Servoing) -> float:
    """Yaw rate, rad/s, that brings the feature to [0, H/2, 0].

    speed_mps is the robot's speed in the direction this camera looks: positive for the leading camera,
    negative for the trailing one; at standstill there is nothing to steer and the rate is zero.
    """
    if speed_mps == 0:
        return 0.0
    x, y = feature.offset_px / camera.focal_px, camera.centre_y_px / camera.focal_px
    jacobian = interaction_matrix(x, y, feature.theta_rad, camera) @ robot_to_camera(camera)
    by_speed, by_yaw = jacobian.T
    error = gains(camera, speed_mps, servoing) * np.array([x, feature.theta_rad])
    return float(-(by_yaw @ (error + by_speed * speed_mps)) / (by_yaw @ by_yaw))
