"""What a run leaves on disk: its directory, journal, settings, figures, map, overlay, and reading them."""
