"""A camera's source as people may read it: without what may be a password."""

import re

PIPED = " ! "
"""What stands between two elements of a GStreamer pipeline, and in no name of a device or a file."""
HIDDEN = "***"
CREDENTIALS, QUERY = re.compile(r"(?<=://)\S*@"), re.compile(r"(://[^\s?]*\?)[^\s\"']+")
SECRET_NAME = r"[\w-]*(?:pw|pass|password|token|secret)"
SECRET = re.compile(rf"\b({SECRET_NAME})\s*=\s*(\"[^\"]*\"|\S+)", re.IGNORECASE)
"""A property of an element of a pipeline: user-pw of rtspsrc is one."""


def is_secret(key: str) -> bool:
    """Whether a dotted key names what only its owner may read."""
    return any(re.fullmatch(SECRET_NAME, part, re.IGNORECASE) for part in key.split("."))


def shown(source: str) -> str:
    """The source; of a URL neither user and password nor the query, of a pipeline no secret property."""
    source = QUERY.sub(rf"\g<1>{HIDDEN}", CREDENTIALS.sub(f"{HIDDEN}@", source))
    return SECRET.sub(rf"\g<1>={HIDDEN}", source) if PIPED in source else source


def in_unicode(name: str) -> bool:
    """Whether a file's name is text; OpenCV ends the process at one that is bytes in no encoding."""
    try:
        name.encode()
    except UnicodeEncodeError:
        return False
    return True
