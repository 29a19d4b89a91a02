"""Reading a file that the user named, whatever it turns out to be."""

import errno
import os
import stat
from io import BufferedReader

from fieldnav.errors import SettingsError
from fieldnav.settings.one_line import one_line

NO_FILE = "is a pipe or a device; allowed is a file"


def open_regular(path: str | os.PathLike[str]) -> BufferedReader:
    """A regular file opened to be read.

    Raises OSError, also for a pipe, which would be waited for without end, and a device, which never ends.
    """
    mode = os.stat(path).st_mode
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise OSError(errno.EINVAL, NO_FILE, str(path))
    return open(path, "rb")  # a folder raises an error of its own


def read_regular(path: str, most_bytes: int) -> bytes:
    """The content of a regular file of at most `most_bytes`; `path` as it was typed. Raises SettingsError."""
    name = one_line(path)
    try:
        with open_regular(path) as file:
            content = file.read(most_bytes + 1)
    except FileNotFoundError as error:
        raise SettingsError(f"{name}: there is no such file") from error
    except IsADirectoryError as error:
        raise SettingsError(f"{name}: cannot be read: is a folder; allowed is a file") from error
    except OSError as error:
        raise SettingsError(f"{name}: cannot be read: {error.strerror}") from error
    except ValueError as error:  # a null byte, or a character that no file name can have
        raise SettingsError(f"{path!r}: is no name that a file can have") from error
    if len(content) > most_bytes:
        size = f"at least {len(content)} bytes long"
        raise SettingsError(f"{name}: is {size}; allowed is a file of at most {most_bytes} bytes")
    return content
