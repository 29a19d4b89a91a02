"""The pictures of a folder, in the order in which they were taken."""

import re
from pathlib import Path

PICTURES = (".jpg", ".jpeg", ".png", ".bmp", ".tif", ".tiff", ".webp")
"""How a picture's name ends."""


def pictures_in(folder: Path) -> list[Path]:
    """The folder's pictures by name, 9.jpg before 10.jpg. Raises OSError."""
    return sorted(filter(_is_picture, folder.iterdir()), key=_in_order)


def _is_picture(path: Path) -> bool:
    """Whether a file is a picture by its name; a hidden one, as memory cards hold, is none."""
    return path.suffix.lower() in PICTURES and not path.name.startswith(".")


def _in_order(path: Path) -> tuple[list[tuple[str, int]], str]:
    parts = re.findall(r"([^0-9]*)([0-9]*)", path.name)
    return [(text, int(number or -1)) for text, number in parts], path.name
