"""Crop-row navigation for four-wheel-steer field robots, by sight alone."""

__version__ = "0.1.0"
