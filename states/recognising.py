"""The word of the features: the newest row against the known one by SIFT (paper III-C)."""

from dataclasses import replace

from fieldnav.messages import Evidence, Frame
from fieldnav.perception.likeness import Likeness, likeness
from fieldnav.perception.recognition import describe
from fieldnav.perception.sidestep.passing_rows import Crossing
from fieldnav.perception.sidestep.row_lines import row_in_view
from fieldnav.perception.sidestep.row_words import DOUBT, by_features, words
from fieldnav.pinhole import Pinhole
from fieldnav.settings.crop import CropProfile
from states.memory import SwitchMemory


class Recognising:
    """Compares the outermost row in view with the stored one: it refreshes that one or takes its place.

    refresh_frames: after so many frames a known row is described anew.
    """

    def __init__(self, crop: CropProfile, refresh_frames: int) -> None:
        self._crop, self._refresh_frames = crop, refresh_frames
        self._frames = 0

    def compare(
        self, frame: Frame, rows: Crossing, switch: SwitchMemory, camera: Pinhole
    ) -> tuple[Crossing, tuple[Evidence, ...]]:
        """The rows with the word of the features on the newest one, and every word on it as evidence."""
        newest = _outermost_in_view(rows, self._crop, camera)
        self._frames += 1
        if newest is None:
            return rows, ()
        before = words(rows, newest, self._crop)
        known = rows.rows[newest].of_old_lane or before.certain
        if known and self._frames % self._refresh_frames:
            return rows, ()
        line = row_in_view(rows, rows.rows[newest].across_m, self._crop, camera)
        assert line, "it was chosen for being in view"
        features = describe(frame.image, line, self._crop, camera, 0.0, camera.ground_middle_px)
        like = likeness(switch.reference, features, self._crop) if switch.reference else None
        if known:
            if like is None or not like.is_new:
                switch.reference = features
        elif like is not None:
            rows = _told(rows, newest, by_features(rows.rows[newest].features, like))
            if words(rows, newest, self._crop).certain:
                switch.reference = features
        return rows, self._evidence(rows, newest, like)

    def _evidence(self, rows: Crossing, newest: int, like: Likeness | None) -> tuple[Evidence, ...]:
        said = words(rows, newest, self._crop)
        compared = (
            (Evidence("share of its features that moved together", like.share, like.threshold),)
            if like
            else ()
        )
        if rows.rows[newest].of_old_lane:
            return compared
        return (
            *compared,
            Evidence("word of the plants for a new row", said.plants),
            Evidence("word of the wheels", said.wheels),
            Evidence("word of the features", said.features),
            Evidence("sum of the words", said.total + DOUBT, DOUBT),
        )


def _outermost_in_view(rows: Crossing, crop: CropProfile, camera: Pinhole) -> int | None:
    inside = [index for index, row in enumerate(rows.rows) if row_in_view(rows, row.across_m, crop, camera)]
    return max(inside, key=lambda index: rows.rows[index].across_m, default=None)


def _told(rows: Crossing, index: int, word: float) -> Crossing:
    told = list(rows.rows)
    told[index] = replace(told[index], features=word)
    return replace(rows, rows=tuple(told))
