"""A process in front of its own terminal, which looks for keys when it is told to; run by test_terminal.py.

Standard input is the terminal; orders come and answers go, a line each, on the descriptor named as argument.
"""

import fcntl
import os
import signal
import socket
import subprocess
import sys
import termios

from fieldnav.operator.terminal import TerminalKeys


def obey(order: str, keys: TerminalKeys, said: list[str]) -> str:
    """Carry out one order of the test; what came of it."""
    if order == "poll":
        requests = keys.poll(0.0)
        for request in requests:
            request.reply(ok=True, said=f"heard {request.command.value}")
        return " ".join(request.command.value for request in requests)
    if order == "said":
        return " ".join(said)
    if order == "fail":
        raise ZeroDivisionError
    if order == "back":
        other = subprocess.Popen(["sleep", "60"], process_group=0, stdin=subprocess.DEVNULL)
        os.tcsetpgrp(0, other.pid)
        return str(other.pid)
    if order == "front":
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTTOU})
        os.tcsetpgrp(0, os.getpgrp())
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGTTOU})
    return ""


def main() -> None:
    fcntl.ioctl(0, termios.TIOCSCTTY, 0)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    said: list[str] = []
    control = socket.socket(fileno=int(sys.argv[1])).makefile("rw")
    with TerminalKeys(said.append) as keys:
        for order in control:
            control.write(obey(order.strip(), keys, said) + "\n")
            control.flush()


main()
