"""What a picture shows: vegetation, plants, rows, the lane under the robot; pure functions, no clock, no I/O.

Begin with `perceive.find` (a frame of the robot's camera) and `unposed.find_unposed` (any picture).
"""
