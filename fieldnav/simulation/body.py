"""How the robot's body moves on soil when its wheels turn: the simulation's ground truth of motion."""

from collections.abc import Mapping
from math import cos, sin

import numpy as np

from fieldnav.messages import Twist, Wheel, WheelSetpoint
from fieldnav.settings.robot import Geometry

SCRUB = 0.8
"""Sideways stiffness of a wheel on loose soil against its rolling one; the driver takes them for alike."""


def body_motion(wheels: Mapping[Wheel, WheelSetpoint], geometry: Geometry, slip: float) -> Twist:
    """Twist of the body that its wheels' rolling and their unwillingness to slide sideways agree on best.

    Weighted least squares of two equations a wheel: along it the rim speed less the slip, across it nothing.
    """
    rows = []
    for wheel, state in wheels.items():
        x, y = geometry.position_m(wheel)
        c, s = cos(state.steering_rad), sin(state.steering_rad)
        rows.append((c, s, x * s - y * c, state.speed_mps * (1 - slip)))
        rows.append((-s * SCRUB, c * SCRUB, (x * c + y * s) * SCRUB, 0.0))
    equations = np.array(rows)
    normal = equations[:, :3].T @ equations
    return Twist(*np.linalg.solve(normal[:, :3], normal[:, 3]).tolist())
