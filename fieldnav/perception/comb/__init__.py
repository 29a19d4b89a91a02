"""The comb finder: parallel rows searched for together, in whatever perspective."""
