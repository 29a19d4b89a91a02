"""A recorded run through today's code: the same frames and telemetry, and what comes of them now."""
