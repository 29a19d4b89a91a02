"""Which fieldnav this is and where it runs, so that a figure can be measured again."""

import os
import platform
import subprocess
from pathlib import Path

import fieldnav

ROOT = Path(fieldnav.__file__).parent.parent
TIMEOUT_S = 10.0


def commit(root: Path = ROOT) -> str:
    """The commit of the checkout at `root`, with -dirty where files differ from it; else the version."""
    if _git(root, "rev-parse", "--show-toplevel") != str(root.resolve()):
        return fieldnav.__version__  # installed; a repository further up is someone else's
    head = _git(root, "rev-parse", "--short=12", "HEAD")
    if head is None:
        return fieldnav.__version__
    return f"{head}-dirty" if _git(root, "status", "--porcelain", "--untracked-files=no") else head


def machine() -> str:
    """The platform and the count of processors."""
    count = os.cpu_count() or 1
    return f"{platform.system()} {platform.machine()}, {count} processor{'s' if count > 1 else ''}"


def _git(root: Path, *arguments: str) -> str | None:
    """What git says, None where it does not know or is not there."""
    command = ["git", "--no-optional-locks", "-C", str(root), *arguments]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=TIMEOUT_S)
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout.strip() if done.returncode == 0 else None
