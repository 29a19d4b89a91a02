"""What a run records: MCAP files, written beside the loop, read back, repaired where broken off."""
