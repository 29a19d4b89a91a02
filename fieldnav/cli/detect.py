"""fieldnav detect."""


def detect() -> None:
    """Find crop rows in pictures."""
    raise NotImplementedError
