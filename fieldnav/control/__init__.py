"""From features to twists, from twists to wheels: pure functions without clock or bus."""
