"""The option of commands that look at pictures of a robot's camera, or of one that nobody knows."""

from typing import Annotated

import typer

RobotOption = Annotated[
    str | None,
    typer.Option(
        help="Robot whose front camera took them; name or path. Without one: the camera is estimated."
    ),
]
