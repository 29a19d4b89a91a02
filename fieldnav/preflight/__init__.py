"""What is looked at before the robot drives: computer, bus, modules, battery, cameras, crop."""
