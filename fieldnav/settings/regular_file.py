"""Reading a file that the user named, whatever it turns out to be."""

import os
import stat

from fieldnav.errors import SettingsError
from fieldnav.settings.one_line import one_line


def read_regular(path: str, most_bytes: int) -> bytes:
    """The content of a regular file of at most `most_bytes`; `path` as it was typed.

    A pipe would be waited for without end and a device never ends. Raises SettingsError.
    """
    name = one_line(path)
    try:
        found = os.stat(path)
        if not stat.S_ISREG(found.st_mode):
            kind = "a folder" if stat.S_ISDIR(found.st_mode) else "a pipe or a device"
            raise SettingsError(f"{name}: cannot be read: is {kind}; allowed is a file")
        with open(path, "rb") as file:
            content = file.read(most_bytes + 1)
    except FileNotFoundError as error:
        raise SettingsError(f"{name}: there is no such file") from error
    except OSError as error:
        raise SettingsError(f"{name}: cannot be read: {error.strerror}") from error
    except ValueError as error:  # a null byte, or a character that no file name can have
        raise SettingsError(f"{path!r}: is no name that a file can have") from error
    if len(content) > most_bytes:
        size = f"at least {len(content)} bytes long"
        raise SettingsError(f"{name}: is {size}; allowed is a file of at most {most_bytes} bytes")
    return content
