"""The procedural plants: shape of the data, limits of the renderer, and that no two crops look alike."""

from functools import cache
from itertools import combinations

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from fieldnav.simulation.plants import CROP_SPECIES, WEED_SPECIES, PlantModel, grow
from fieldnav.simulation.plants.leaf import Shape, Stance, halves, pieces, whole
from fieldnav.simulation.plants.model import CANOPY_RADIUS, LONGEST_REACH

SPECIES = CROP_SPECIES + WEED_SPECIES
BUDGET = {"coriander": 14, "winter-wheat": 14} | dict.fromkeys(WEED_SPECIES, 14)
LARGE_CROP_BUDGET = 24
MOST_VERTICES = 12
VARIANTS = 12
TILT_RAD = np.radians(65)
HEIGHT = 0.6  # of a plant seen, in canopy diameters: the middle of what is sown
RASTER_PX = 300
STANCE = Stance((0.0, 0.0, 0.0), azimuth_rad=0.7, rise_rad=0.9, bend_rad=1.2, length=2.0, roll_rad=0.1)
SHAPE = Shape(stations=(0.0, 0.3, 0.7, 1.0), half_widths=(0.02, 0.2, 0.15, 0.01))


@cache
def _variants(species: str) -> list[PlantModel]:
    return [grow(species, seed / (VARIANTS - 1), np.random.default_rng(seed)) for seed in range(VARIANTS)]


def _raster(xy: NDArray[np.float64]) -> NDArray[np.int32]:
    """Pixels of points given in canopy diameters about the image's middle."""
    return np.round((xy + 0.75) / 1.5 * RASTER_PX).astype(np.int32)


def _seen_from(model: PlantModel, yaw_rad: float) -> NDArray[np.float64]:
    """Outlines (n_leaves, n_vertices, 2) as seen from afar, 65 degrees below the horizontal."""
    x, y, z = (model.leaves[..., i].astype(float) for i in range(3))
    right = x * np.cos(yaw_rad) - y * np.sin(yaw_rad)
    ahead = x * np.sin(yaw_rad) + y * np.cos(yaw_rad)
    return np.stack([right, -ahead * np.sin(TILT_RAD) - HEIGHT * (z - 0.5) * np.cos(TILT_RAD)], axis=-1)


def _cover(model: PlantModel) -> NDArray[np.bool_]:
    """Where the plant, seen from straight above, hides the ground."""
    image = np.zeros((RASTER_PX, RASTER_PX), np.uint8)
    for outline in model.leaves[..., :2]:
        cv2.fillPoly(image, [_raster(outline.astype(float))], 1)
    return image.astype(bool)


def _elongation(model: PlantModel) -> float:
    """Length over width of a plant's outlines, seen flat; the mean, large ones counting by their size."""
    centred = model.leaves - model.leaves.mean(axis=1, keepdims=True)
    length, width, _ = np.linalg.svd(centred.astype(float), compute_uv=False).T
    return float(np.average(length / width, weights=length * width))


@cache
def _habit(species: str) -> NDArray[np.float64]:
    """What tells species apart, about 0 to 1 each: leaf count, elongation, coverage, two colour ratios."""
    models = _variants(species)
    count = np.mean([len(model.leaves) for model in models]) / LARGE_CROP_BUDGET
    elongation = np.log(np.mean([_elongation(model) for model in models])) / 2
    coverage = np.mean([_cover(model).mean() for model in models]) * 2
    blue, green, red = np.mean([model.colours().mean(axis=0) for model in models], axis=0)
    return np.array([count, elongation, coverage, 2 * blue / green, 2 * red / green])


@pytest.mark.parametrize("species", SPECIES)
def test_every_species_grows_in_the_promised_shapes_and_types(species: str) -> None:
    for model in _variants(species):
        n_leaves, n_vertices, _ = model.leaves.shape
        assert 3 <= n_vertices <= MOST_VERTICES
        assert model.leaves.dtype == model.normals.dtype == model.tone.dtype == np.float32
        assert model.normals.shape == (n_leaves, 3)
        assert model.tone.shape == (n_leaves,)
        assert model.palette.dtype == np.uint8
        assert model.palette.ndim == 2 and len(model.palette) >= 2


@pytest.mark.parametrize("species", SPECIES)
@settings(max_examples=20, deadline=None)
@given(growth=st.floats(0, 1), seed=st.integers(0, 2**32 - 1))
def test_a_plant_fills_its_unit_canopy_and_no_more(species: str, growth: float, seed: int) -> None:
    model = grow(species, growth, np.random.default_rng(seed))

    reach = np.hypot(model.leaves[..., 0], model.leaves[..., 1]).max()
    assert CANOPY_RADIUS - 1e-5 <= reach <= LONGEST_REACH + 1e-5
    assert model.leaves[..., 2].min() >= 0
    assert model.leaves[..., 2].max() == pytest.approx(1, abs=1e-5)
    assert model.tone.min() >= 0 and model.tone.max() <= 1


@pytest.mark.parametrize("species", SPECIES)
@settings(max_examples=20, deadline=None)
@given(growth=st.floats(0, 1), seed=st.integers(0, 2**32 - 1))
def test_normals_are_unit_and_face_up(species: str, growth: float, seed: int) -> None:
    model = grow(species, growth, np.random.default_rng(seed))

    np.testing.assert_allclose(np.linalg.norm(model.normals, axis=1), 1, atol=1e-5)
    assert model.normals[:, 2].min() > 0


@pytest.mark.parametrize("species", SPECIES)
def test_equal_generators_give_equal_plants_and_others_differ(species: str) -> None:
    first, again, other = (grow(species, 0.5, np.random.default_rng(seed)) for seed in (7, 7, 8))

    np.testing.assert_array_equal(first.leaves, again.leaves)
    np.testing.assert_array_equal(first.tone, again.tone)
    assert first.leaves.shape != other.leaves.shape or not np.allclose(first.leaves, other.leaves, atol=0.01)


@pytest.mark.parametrize("species", SPECIES)
def test_leaves_of_one_plant_face_different_ways(species: str) -> None:
    spread = np.mean([np.linalg.norm(model.normals.std(axis=0)) for model in _variants(species)])

    assert spread > 0.1


@pytest.mark.parametrize("species", SPECIES)
def test_growth_changes_the_plant(species: str) -> None:
    young, old = (grow(species, growth, np.random.default_rng(3)) for growth in (0.0, 1.0))

    assert young.leaves.shape != old.leaves.shape or not np.allclose(young.leaves, old.leaves, atol=1e-3)


@pytest.mark.parametrize("species", SPECIES)
def test_the_polygon_budget_is_held(species: str) -> None:
    most = max(len(model.leaves) for model in _variants(species))

    assert most <= BUDGET.get(species, LARGE_CROP_BUDGET)


@pytest.mark.parametrize("species", SPECIES)
def test_every_colour_of_a_palette_is_green(species: str) -> None:
    blue, green, red = grow(species, 0.5, np.random.default_rng(0)).palette.astype(float).T

    excess_green = (2 * green - red - blue) / (red + green + blue)

    assert excess_green.min() > 0.12


def test_colours_run_from_the_first_anchor_to_the_last() -> None:
    plant = grow("beans", 0.5, np.random.default_rng(0))
    ends = PlantModel(plant.leaves[:2], plant.normals[:2], np.array([0, 1], np.float32), plant.palette)

    np.testing.assert_allclose(ends.colours(), plant.palette[[0, -1]])


def test_wheat_is_bluer_and_lemon_balm_yellower_than_sugar_beet() -> None:
    wheat, balm, beet = (_habit(species)[3:] for species in ("winter-wheat", "lemon-balm", "sugar-beet"))

    assert wheat[0] > beet[0] + 0.1
    assert balm[1] > beet[1] + 0.2


@pytest.mark.parametrize("species", CROP_SPECIES)
def test_a_crop_plant_is_centred_on_its_stem(species: str) -> None:
    offsets = []
    for model in _variants(species):
        y, x = np.nonzero(_cover(model))
        offsets.append(np.hypot(x.mean() - RASTER_PX / 2, y.mean() - RASTER_PX / 2) / RASTER_PX * 1.5)

    assert np.mean(offsets) < 0.1


def test_no_two_crops_look_alike() -> None:
    habits = {species: _habit(species) for species in CROP_SPECIES}

    distances = {
        (a, b): float(np.linalg.norm(habits[a] - habits[b])) for a, b in combinations(CROP_SPECIES, 2)
    }

    assert min(distances.values()) > 0.1, min(distances, key=lambda pair: distances[pair])


def test_no_weed_looks_like_a_crop() -> None:
    crops = [_habit(species) for species in CROP_SPECIES]

    nearest = [min(float(np.linalg.norm(_habit(weed) - crop)) for crop in crops) for weed in WEED_SPECIES]

    assert min(nearest) > 0.1


def test_grasses_are_slender_and_bushes_cover_the_ground() -> None:
    elongation = {species: _habit(species)[1] for species in CROP_SPECIES}
    coverage = {species: _habit(species)[2] for species in CROP_SPECIES}

    assert set(sorted(elongation, key=lambda species: elongation[species])[-2:]) == {"maize", "winter-wheat"}
    assert set(sorted(coverage, key=lambda species: coverage[species])[-2:]) == {"potato", "lemon-balm"}


@pytest.mark.parametrize("species", SPECIES)
def test_outlines_can_be_filled_as_if_convex(species: str) -> None:
    convex_px = exact_px = 0
    for turn, model in enumerate(_variants(species)):
        for outline in _raster(_seen_from(model, yaw_rad=0.5 * turn)):
            convex, exact = np.zeros((2, RASTER_PX, RASTER_PX), np.uint8)
            convex_px += int(cv2.fillConvexPoly(convex, outline, 1).sum())
            exact_px += int(cv2.fillPoly(exact, [outline], 1).sum())

    assert convex_px == pytest.approx(exact_px, rel=0.08)


def test_an_unknown_species_is_refused() -> None:
    with pytest.raises(KeyError, match="triffid"):
        grow("triffid", 0.5, np.random.default_rng(0))


def test_a_midrib_is_as_long_as_its_leaf_and_bends_down() -> None:
    line = STANCE.midrib(np.linspace(0, 1, 2001))

    assert np.linalg.norm(np.diff(line, axis=0), axis=1).sum() == pytest.approx(2.0, rel=1e-5)
    start, end = (line[i + 1] - line[i] for i in (0, -2))
    assert np.arcsin(start[2] / np.linalg.norm(start)) == pytest.approx(0.9, abs=1e-2)
    assert np.arcsin(end[2] / np.linalg.norm(end)) == pytest.approx(0.9 - 1.2, abs=1e-2)


def test_halves_share_the_midrib_and_stand_up_when_folded() -> None:
    left, right = halves(STANCE, SHAPE, fold_rad=0.4)

    np.testing.assert_allclose(left[-4:], right[-4:])
    flat_left, flat_right = halves(STANCE, SHAPE, fold_rad=0.0)
    assert left[:4, 2].sum() > flat_left[:4, 2].sum()
    assert right[:4, 2].sum() > flat_right[:4, 2].sum()


def test_pieces_of_a_blade_join_without_a_gap() -> None:
    lower, upper = pieces(STANCE, SHAPE, (0, 2, 3))

    np.testing.assert_allclose(lower[2:4], upper[[0, -1]])
    np.testing.assert_allclose(np.concatenate([lower[:3], upper[1:3], lower[3:]]), whole(STANCE, SHAPE))
