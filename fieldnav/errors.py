"""The errors of fieldnav: one small tree, raised where a fault is seen and caught once at the top."""

from fieldnav.faults import FaultKind


class FieldnavError(Exception):
    """Anything fieldnav stops for; its text is one line that a person can act on."""


class SettingsError(FieldnavError):
    """A file or an option is wrong; names the file, the key, the value and what is allowed."""


class DriverError(FieldnavError):
    """A camera, the bus or a wheel module does not do what it must; `fault` decides what is done about it."""

    def __init__(self, said: str, fault: FaultKind = FaultKind.BUS_OFF) -> None:
        super().__init__(said)
        self.fault = fault


class OutputError(FieldnavError):
    """A run directory or a report cannot be written."""


class PictureError(FieldnavError):
    """Bytes are no picture, or a damaged one; whoever knows where they are from names it."""

    def __init__(self, damaged: bool = False) -> None:
        super().__init__("is no whole picture" + (": its data is damaged" if damaged else ""))
