"""The phases of a mission and their colours: on maps, in plots, in reports."""

INK = "#2b2b2b"
OTHER = "Other"
"""Standing still before and after the lanes: no stretch of the path, and so not in the legend."""

PHASE_COLOURS = {
    "Follow": "#1f6fb4",
    "Acquiring": "#6cc5e8",
    "Coasting": "#8a5fc4",
    "Exit": "#e69200",
    "Sidestep": "#d4357f",
    "Paused": "#8c8c8c",
    "Fault": "#d01c1c",
    OTHER: "#404040",
}
"""A colour a phase; a state takes that of the innermost of its names that is listed here."""


def phase_of(state: str) -> str:
    """The phase that a state's name, its parents' names before it, belongs to."""
    names = state.replace(".", "_").split("_")
    return next((name for name in reversed(names) if name in PHASE_COLOURS), OTHER)
