"""The lines of can.log: candump's format, which python-can, cantools, can-utils and SavvyCAN read."""

import can

ERROR_FLAG = 0x20000000
"""In an identifier: an error frame, whose other bits are the error's class (linux/can/error.h)."""
IDENTIFIER_MASK = 0x1FFFFFFF
BRS_FLAG, ESI_FLAG = 0x01, 0x02
"""Of a CAN FD frame: switches to the faster bit rate; its sender is error passive."""
UNNAMED = "_"
"""In place of a character that a channel's name must not have in the log; and of a name that is empty."""


class LogWriter(can.CanutilsLogWriter):
    """python-can's writer with lines of its own: it drops an error frame's class and a request's length."""

    def write(self, frame: can.Message, stamp_s: float) -> None:
        """Write a line. Raises OSError."""
        self.file.write(log_line(frame, stamp_s, self.channel))

    def on_message_received(self, msg: can.Message) -> None:
        self.write(msg, msg.timestamp)


def log_line(frame: can.Message, stamp_s: float, channel: str) -> str:
    """The line of a frame; `channel` as `shown_channel` makes it."""
    direction = "R" if frame.is_rx else "T"
    return f"({stamp_s:f}) {channel} {_identifier(frame)}#{_content(frame)} {direction}\n"


def shown_channel(name: str) -> str:
    """A channel's name as one word of printable ASCII; a number as python-can has it, can0."""
    word = "".join(letter if "!" <= letter <= "~" else UNNAMED for letter in name) or UNNAMED
    return f"can{word}" if word.isdigit() else word


def _identifier(frame: can.Message) -> str:
    if frame.is_error_frame:
        return f"{ERROR_FLAG | frame.arbitration_id & IDENTIFIER_MASK:08X}"
    return f"{frame.arbitration_id:08X}" if frame.is_extended_id else f"{frame.arbitration_id:03X}"


def _content(frame: can.Message) -> str:
    if frame.is_remote_frame:
        return f"R{frame.dlc}" if frame.dlc else "R"
    data = frame.data.hex().upper()
    if not frame.is_fd:
        return data
    flags = BRS_FLAG * frame.bitrate_switch | ESI_FLAG * frame.error_state_indicator
    return f"#{flags:X}{data}"
