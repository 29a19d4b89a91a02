"""The options of `fieldnav replay` for recordings that fieldnav has not made."""

from enum import Enum
from pathlib import Path
from typing import Annotated

import typer

from fieldnav.cli.output_folder import output_path


class DirectionOption(Enum):
    FORWARD = "forward"
    BACKWARD = "backward"


FASTEST_MPS, FASTEST_HZ = 3.0, 240.0
"""As in robot files."""
MOST_LANES = 1000

FrontOption = Annotated[
    str | None, typer.Option("--front", help="Topic of the front camera, in a bag or MCAP.", metavar="TOPIC")
]
RearOption = Annotated[
    str | None,
    typer.Option("--rear", help="Topic, video or folder of the rear camera.", metavar="TOPIC|FILE"),
]
OdometryOption = Annotated[
    str | None,
    typer.Option("--odometry", help="Topic that tells how the robot moved, in a bag.", metavar="TOPIC"),
]
SpeedOption = Annotated[
    float | None,
    typer.Option(
        "--speed",
        min=0,
        max=FASTEST_MPS,
        help="Of the recorded robot, in m/s; the profile's speeds.follow_mps where not given.",
    ),
]
DirectionChoice = Annotated[
    DirectionOption, typer.Option("--direction", help="In which the recorded robot drives.")
]
RateOption = Annotated[
    float | None,
    typer.Option(
        "--rate",
        min=0.1,
        max=FASTEST_HZ,
        help="Pictures a second, of a folder; of a video, if its own is wrong.",
    ),
]
LanesOption = Annotated[
    int | None, typer.Option("--lanes", min=1, max=MOST_LANES, help="Lanes of a foreign recording; 1.")
]
RobotOption = Annotated[
    str | None, typer.Option("--robot", help="Robot of a foreign recording; name or path.")
]
AgainOption = Annotated[
    bool, typer.Option("--again", help="Begin anew after each stop in a foreign recording.")
]
OutOption = Annotated[
    Path | None,
    typer.Option(
        "--out",
        parser=output_path,
        help="Folder for the run directory of a foreign replay; as --runs.",
        metavar="DIR",
    ),
]
