"""The pool of drawn pictures: whole chunks are kept, others drawn."""

from pathlib import Path

import numpy as np
import pytest

from fieldnav.errors import OutputError, SettingsError
from fieldnav.perception.row_network import normalised
from fieldnav.training.batches import BATCH, TrainingPictures, plain_batches
from fieldnav.training.drawn_picture import draw
from fieldnav.training.pool import SEEDS, Chunk, Pool, drawing


@pytest.fixture
def pool(tmp_path: Path) -> Pool:
    return Pool(tmp_path, seed=3, chunks=4, chunk_pictures=2)


def test_a_chunk_holds_the_pictures_of_its_seeds(pool: Pool) -> None:
    pool.draw_chunk(1)

    chunk, expected = pool.load(1), draw(4 * SEEDS + 2)
    assert len(chunk) == 2
    assert np.array_equal(chunk.images[0], expected.image)
    assert np.array_equal(chunk.heat[0], expected.heat)
    assert np.array_equal(chunk.ignored[0], expected.ignored)


def test_the_chunks_that_are_missing_are_drawn_the_held_out_one_first(pool: Pool) -> None:
    pool.path(1).touch()

    assert pool.drawn() == [1]
    assert pool.missing() == [3, 0, 2]


def test_half_written_chunks_do_not_count(pool: Pool) -> None:
    pool.path(0).with_suffix(".partial").touch()

    assert pool.drawn() == []


def test_chunks_of_another_seed_do_not_count(pool: Pool, tmp_path: Path) -> None:
    pool.path(0).touch()

    assert Pool(tmp_path, seed=4, chunks=4).drawn() == []


def test_a_damaged_chunk_is_named(pool: Pool) -> None:
    pool.path(2).write_bytes(b"no chunk")

    with pytest.raises(SettingsError, match=r"chunk0002\.npz is no chunk"):
        pool.load(2)


def test_processes_draw_what_is_missing(tmp_path: Path) -> None:
    pool = Pool(tmp_path / "new", seed=0, chunks=2, chunk_pictures=1)

    with drawing(pool, processes=2) as drawers:
        drawers.wait()
        drawers.check()

    assert pool.missing() == []


def test_a_pool_that_cannot_be_made_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    pool = Pool(tmp_path / "file" / "pool", seed=0, chunks=2)

    with pytest.raises(OutputError, match="file/pool"), drawing(pool, processes=1):
        pass


def some_chunk(pictures: int) -> Chunk:
    random = np.random.default_rng(0)
    images = random.integers(0, 256, (pictures, 128, 192, 3)).astype(np.uint8)
    heat = np.repeat(images[:, ::2, ::2, 0], 1, axis=1)
    return Chunk(images, heat, heat > 200)


def test_a_batch_is_mirrored_together_with_its_truth() -> None:
    pictures = TrainingPictures(np.random.default_rng(1))
    pictures.add(0, some_chunk(5))

    batch = pictures.next_batch()

    assert batch.inputs.shape == (BATCH, 3, 128, 192)
    assert batch.heat.shape == batch.judged.shape == (BATCH, 1, 64, 96)
    for inputs, heat in zip(batch.inputs, batch.heat, strict=True):
        aligned = np.corrcoef(inputs[0, ::2, ::2].ravel(), heat[0].ravel())[0, 1]
        mirrored = np.corrcoef(inputs[0, ::2, 1::2].ravel(), heat[0].ravel())[0, 1]
        assert max(aligned, mirrored) > 0.9


def test_held_out_pictures_come_in_order_and_once() -> None:
    chunk = some_chunk(BATCH + 3)

    batches = list(plain_batches(chunk))

    assert [len(batch.inputs) for batch in batches] == [BATCH, 3]
    assert np.array_equal(batches[1].judged[:, 0] == 0, chunk.ignored[BATCH:])


def test_a_normalised_image_does_not_depend_on_brightness() -> None:
    images = np.random.default_rng(2).integers(60, 120, (2, 128, 192, 3)).astype(np.uint8)

    plain, brighter = normalised(images), normalised(images + np.uint8(80))

    assert plain.shape == (2, 3, 128, 192)
    assert plain.dtype == np.float32
    assert np.abs(plain - brighter).max() < 1e-3
    assert abs(plain.mean()) < 1e-4
