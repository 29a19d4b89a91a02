"""The row end as a decision over time and distance (paper phases 1 and 2)."""

from fieldnav.messages import Evidence


class Emptiness:
    """How long, and over what distance, a part of the view has held no crop."""

    def __init__(self, confirm_s: float, confirm_m: float) -> None:
        self._confirm_s, self._confirm_m = confirm_s, confirm_m
        self._since: tuple[float, float] | None = None
        self.time_s = 0.0
        self.distance_m = 0.0

    def add(self, crop_left: bool, now_s: float, travelled_m: float) -> bool:
        """Take in whether a frame shows crop there; true once the emptiness has lasted."""
        if crop_left:
            self._since = None
            self.time_s = self.distance_m = 0.0
            return False
        since_s, since_m = self._since = self._since or (now_s, travelled_m)
        self.time_s, self.distance_m = now_s - since_s, abs(travelled_m - since_m)
        return self.time_s >= self._confirm_s and self.distance_m >= self._confirm_m

    def evidence(self, where: str) -> tuple[Evidence, ...]:
        return (
            Evidence(f"no crop in the {where} for", self.time_s, self._confirm_s, "s"),
            Evidence(f"no crop in the {where} over", self.distance_m, self._confirm_m, "m"),
        )
