"""Where a mission's socket lies: in a folder that only its user can enter, under the run's name."""

import hashlib
import os
import stat
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from fieldnav.errors import OutputError

RUNTIME_VARIABLE = "XDG_RUNTIME_DIR"
SUFFIX = ".sock"
LONGEST_PATH_BYTES = 107
"""sun_path of unix(7) holds 108 bytes with the zero at its end."""
DIGEST_DIGITS = 16
SHORTEST_NAME_BYTES = 1 + DIGEST_DIGITS + len(SUFFIX)
PRIVATE_FOLDER = 0o700
FOREIGN_BITS = 0o077
"""What a file's mode allows others."""


@dataclass(frozen=True, slots=True)
class SocketPlace:
    """The user and the folders that sockets may lie in; the first one that can be had is used."""

    user: int = field(default_factory=os.getuid)
    temporary: Path = field(default_factory=lambda: Path(tempfile.gettempdir()))
    environment: Mapping[str, str] = field(default_factory=lambda: os.environ)

    @property
    def folders(self) -> tuple[Path, ...]:
        """The user's runtime folder where it is set and fine, then the temporary one; the best first.

        A mission started as a service has no runtime folder where its operator's shell has one: who looks for
        a mission looks in both.
        """
        beside = self.temporary / f"fieldnav-{self.user}"
        runtime = self.environment.get(RUNTIME_VARIABLE, "")
        return (Path(runtime) / "fieldnav", beside) if self._fine(runtime) else (beside,)

    def make(self) -> Path:
        """The folder for a new socket, made where it lacks. Raises OutputError."""
        folder = self.folders[0]
        try:
            with suppress(FileExistsError):
                folder.mkdir(mode=PRIVATE_FOLDER)
        except OSError as error:
            raise OutputError(
                f"{folder}: cannot be made for the operator's socket: {error.strerror}; "
                f"allowed is a {RUNTIME_VARIABLE} or TMPDIR you can write"
            ) from error
        if complaint := self.complaint(folder):
            raise OutputError(complaint)
        return folder

    def complaint(self, folder: Path) -> str:
        """Why a folder cannot be trusted with a socket, in words; empty when it can, or is not there."""
        try:
            found = folder.lstat()
        except FileNotFoundError:
            return ""
        except OSError as error:
            return f"{folder}: cannot be looked at: {error.strerror}"
        if not stat.S_ISDIR(found.st_mode):
            return f"{folder}: is no folder; remove it, the operator's socket belongs there"
        if found.st_uid != self.user:
            return f"{folder}: belongs to user {found.st_uid}; allowed is {self.user}, who runs the mission"
        if found.st_mode & FOREIGN_BITS:
            mode = stat.S_IMODE(found.st_mode)
            return f"{folder}: mode {mode:04o} lets others in; allowed is 0700: chmod 700 {folder}"
        return ""

    def _fine(self, runtime: str) -> bool:
        """Whether a runtime folder is as the XDG specification has it, and short enough for a socket."""
        if not os.path.isabs(runtime) or "\0" in runtime:
            return False
        try:
            found = os.stat(runtime)
        except OSError:
            return False
        private = found.st_uid == self.user and not found.st_mode & FOREIGN_BITS
        return private and stat.S_ISDIR(found.st_mode) and _room(Path(runtime) / "fieldnav") >= 0


def socket_path(folder: Path, run: str) -> Path:
    """The socket of a run's directory name; a long one is shortened by a digest. Raises OutputError."""
    whole = folder / f"{run}{SUFFIX}"
    if len(os.fsencode(whole)) <= LONGEST_PATH_BYTES:
        return whole
    room = _room(folder)
    if room < 0:
        raise OutputError(
            f"{folder}: too long for a socket; allowed are {LONGEST_PATH_BYTES} bytes with its name: "
            f"set {RUNTIME_VARIABLE} or TMPDIR to a shorter one"
        )
    digest = hashlib.sha256(os.fsencode(run)).hexdigest()[:DIGEST_DIGITS]
    return folder / f"{os.fsencode(run)[:room].decode(errors='ignore')}-{digest}{SUFFIX}"


def _room(folder: Path) -> int:
    """Bytes of a run's name that find place before a digest; negative where not even that does."""
    return LONGEST_PATH_BYTES - len(os.fsencode(folder)) - 1 - SHORTEST_NAME_BYTES
