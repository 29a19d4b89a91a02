"""Where the lane runs and ends, in metres, from many frames and the robot's movement; no clock, no I/O."""
