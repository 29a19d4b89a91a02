"""The simulated robot offered to another process, in real time: its bus and cameras, on loopback."""

LOOPBACK = "127.0.0.1"
"""Nothing is offered beyond this machine: whoever reaches the bus drives the robot."""
