"""The state machine as a picture: boxes, arrows, SVG."""
