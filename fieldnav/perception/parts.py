"""The far and the near half of an image (paper III-A.3: where row ends are judged)."""

from fieldnav.messages import Centres
from fieldnav.perception.row_end import ImagePart
from fieldnav.pinhole import Pinhole


def in_part(centres: Centres, camera: Pinhole, part: ImagePart) -> Centres:
    """The plants whose centre lies in that part of the image."""
    if part is ImagePart.WHOLE:
        return centres
    keep = (centres.position_px[:, 1] < camera.centre_y_px) == (part is ImagePart.TOP)
    return Centres(
        centres.position_px[keep], centres.area_px[keep], centres.top_px[keep], centres.bottom_px[keep]
    )
