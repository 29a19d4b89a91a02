"""Vegetation: what counts as a plant, and where."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fieldnav.perception.vegetation import excess_green, find_plants, segment
from fieldnav.settings.crop import Vegetation
from tests_perception import SOIL_BGR, draw_field, pinhole, profile, stand

CAMERA, BEET = pinhole(), profile(3, 0.35)
