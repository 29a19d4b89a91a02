"""Rows that pass while the robot steps sideways, and the lane among them (paper III-C)."""
