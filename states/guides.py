"""Which guide a crop profile asks for, and how the wheels then stand within the rows."""

from fieldnav.messages import Direction, Steering
from fieldnav.settings.crop import ControlLaw, CropProfile
from states.behaviour import Task
from states.guide import Guide
from states.paper_guide import PaperGuide
from states.path_guide import PathGuide


def guide_for(task: Task, direction: Direction) -> Guide:
    """A guide for one lane."""
    if task.crop.control.law is ControlLaw.PAPER:
        return PaperGuide(task, direction)
    return PathGuide(task, direction)


def steering_of(crop: CropProfile) -> Steering:
    """How twists become wheel commands within the rows; the paper's wheels stay straight."""
    return Steering.DIFFERENTIAL if crop.control.law is ControlLaw.PAPER else crop.control.steering
