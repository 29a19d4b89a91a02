"""The program: what it refuses; and where PyTorch is installed, that the network learns and is read again."""

import importlib.util
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
import pytest

from fieldnav.training.__main__ import main, parse
from fieldnav.training.batches import TrainingPictures
from fieldnav.training.pool import Chunk, Pool

needs_torch = pytest.mark.skipif(
    importlib.util.find_spec("torch") is None or importlib.util.find_spec("onnx") is None,
    reason="needs the extra `training`",
)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "required: --out"),
        (["--out", "rows.txt"], "rows.txt: must end in .onnx"),
        (["--out", "nowhere/rows.onnx"], "nowhere/rows.onnx: there is no folder"),
        (["--out", "rows.onnx", "--pictures", "1500"], "--pictures 1500"),
        (["--out", "rows.onnx", "--pictures", "1000"], "--pictures 1000"),
        (["--out", "rows.onnx", "--minutes", "0"], "--minutes 0"),
        (["--out", "rows.onnx", "--minutes", "nan"], "--minutes nan"),
        (["--out", "rows.onnx", "--seed", "-1"], "--seed -1"),
        (["--out", "rows.onnx", "--seed", "x"], "--seed: invalid int value"),
        (["--out", "rows.onnx", "--processes", "0"], "--processes 0"),
        (["--out", "rows.onnx", "--threads", "0"], "--threads 0"),
        (["--out", "rows.onnx", "--epochs", "3"], "--epochs"),
    ],
)
def test_wrong_input_is_told_in_one_line(
    arguments: Sequence[str],
    said: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)

    status = main(arguments)

    out, error = capsys.readouterr()
    assert status == 2
    assert out == ""
    assert error.startswith("error: ") and error.count("\n") == 1
    assert said in error


def test_the_pool_lies_beside_the_network_by_default(tmp_path: Path) -> None:
    config = parse(["--out", str(tmp_path / "rows.onnx"), "--pictures", "3000"])

    assert config.pool == Pool(tmp_path / "rows.pool", seed=0, chunks=3)
    assert config.pool.held_out == 2


def upright_rows(pictures: int) -> Chunk:
    """Images of bright upright lines on a dark ground, with their truth."""
    images = np.zeros((pictures, 128, 192, 3), np.uint8)
    heat = np.zeros((pictures, 64, 96), np.uint8)
    for image, truth, shift in zip(images, heat, range(pictures), strict=True):
        image[:, 8 + 2 * (shift % 16) :: 40] = image[:, 9 + 2 * (shift % 16) :: 40] = 200
        truth[:, 4 + shift % 16 :: 20] = 255
    return Chunk(images, heat, np.zeros(heat.shape, np.bool_))


@needs_torch
@pytest.mark.filterwarnings(
    "ignore::DeprecationWarning"
)  # of PyTorch's exporter, see fieldnav/training/export
def test_the_network_learns_and_opencv_reads_it(tmp_path: Path) -> None:
    from fieldnav.training.export import check_onnx, write_onnx  # noqa: PLC0415 - needs PyTorch
    from fieldnav.training.network import parameter_count  # noqa: PLC0415 - needs PyTorch
    from fieldnav.training.train import Trainer, held_out_loss  # noqa: PLC0415 - needs PyTorch

    pictures, trainer = TrainingPictures(np.random.default_rng(0)), Trainer()
    pictures.add(0, upright_rows(16))

    trainer.step(pictures.next_batch(), 0.0)
    first = trainer.loss
    for step in range(8):
        trainer.step(pictures.next_batch(), step / 8)
    trainer.network.eval()
    write_onnx(trainer.network, tmp_path / "rows.onnx")

    assert parameter_count(trainer.network) <= 100_000
    assert trainer.loss.heat < first.heat
    assert np.isfinite(held_out_loss(trainer.network, upright_rows(4)).heat)
    check_onnx(trainer.network, tmp_path / "rows.onnx")
    reader = cv2.dnn.readNetFromONNX(str(tmp_path / "rows.onnx"))
    reader.setInput(np.zeros((1, 3, 128, 192), np.float32), "picture")
    heat, field = reader.forward(["heat", "field"])
    assert (heat.shape, field.shape) == ((1, 1, 64, 96), (1, 1))
