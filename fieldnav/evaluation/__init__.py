"""What a simulated run was worth, judged by the simulation's truth."""
