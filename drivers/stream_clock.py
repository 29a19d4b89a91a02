"""When a stream's frames were made, on this machine's clock, by the stamps that they bring themselves."""

MAX_DRIFT = 0.001
"""Two clocks of quartz go apart by a tenth of this. Seconds a second."""


class StreamClock:
    """Tells a late frame by its own stamp; one for each time that a stream is opened.

    The frame that took the least time from its stamp to its arrival is taken for punctual, and all others
    are late by so much as they took longer: a network that held them up does not make them look fresh.
    """

    def __init__(self) -> None:
        self._own_s = self._arrived_s = self._least_s = 0.0
        self._begun = False

    def punctual_s(self, own_s: float, arrived_s: float) -> float:
        """When a frame with the stamp `own_s` would have arrived had nothing held it up; at most `arrived_s`.

        A stamp that is not after the one before begins anew: the stream has no stamps, or set its clock.
        """
        if not self._begun or own_s <= self._own_s:
            self._least_s = arrived_s - own_s
        else:
            drifted_s = MAX_DRIFT * (arrived_s - self._arrived_s)
            self._least_s = min(arrived_s - own_s, self._least_s + drifted_s)
        self._begun, self._own_s, self._arrived_s = True, own_s, arrived_s
        return own_s + self._least_s
