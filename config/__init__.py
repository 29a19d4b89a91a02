"""Shipped data: crop profiles, robots, fields, and the wire layout of the wheel modules."""
