"""For all tests: a machine that others use, too, is no fault of the code's."""

from hypothesis import settings

settings.register_profile("shared machine", deadline=None)
settings.load_profile("shared machine")
