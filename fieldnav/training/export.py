"""A trained network as an ONNX file that OpenCV reads, and a JSON file that says how it was trained."""

import json
from dataclasses import asdict
from pathlib import Path

import cv2
import numpy as np
import onnx
import torch

from fieldnav.errors import OutputError
from fieldnav.training.canvas import HEIGHT_PX, WIDTH_PX
from fieldnav.training.network import RowNetwork, parameter_count
from fieldnav.training.train import Trained

OPSET = 17
INPUT, OUTPUTS = "picture", ["heat", "field"]
MAX_DIFFERENCE = 1e-3  # of the logits between PyTorch and OpenCV


def export(trained: Trained, path: Path, seed: int) -> None:
    """Write the network and the JSON; raises OutputError if it cannot, or if OpenCV reads another network."""
    partial = path.with_suffix(".partial")
    try:
        write_onnx(trained.network, partial)
        check_onnx(trained.network, partial)
        partial.replace(path)
        path.with_suffix(".json").write_text(_description(trained, seed), encoding="utf-8")
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}") from error


def write_onnx(network: RowNetwork, path: Path) -> None:
    """Write the network for one normalised image, shape (1, 3, 128, 192); it must be in evaluation mode."""
    example = torch.zeros(1, 3, HEIGHT_PX, WIDTH_PX)
    torch.onnx.export(
        network,
        (example,),
        str(path),
        input_names=[INPUT],
        output_names=OUTPUTS,
        opset_version=OPSET,
        dynamo=False,  # the newer exporter needs further packages and opset 18
    )
    onnx.checker.check_model(str(path))


def check_onnx(network: RowNetwork, path: Path) -> None:
    """Raise OutputError unless OpenCV computes of the file what PyTorch computes of the network."""
    example = np.random.default_rng(0).standard_normal((1, 3, HEIGHT_PX, WIDTH_PX), dtype=np.float32)
    with torch.inference_mode():
        expected = [output.numpy() for output in network(torch.from_numpy(example))]
    reader = cv2.dnn.readNetFromONNX(str(path))
    reader.setInput(example, INPUT)
    for found, wanted in zip(reader.forward(OUTPUTS), expected, strict=True):
        difference = float(np.abs(found - wanted).max())
        if not difference <= MAX_DIFFERENCE:
            raise OutputError(
                f"OpenCV reads {path} as another network: its outputs differ by {difference:.2g}"
            )


def _description(trained: Trained, seed: int) -> str:
    facts = {
        "steps": trained.steps,
        "pictures": trained.pictures,
        "seed": seed,
        "parameters": parameter_count(trained.network),
        "training_loss": asdict(trained.training),
        "held_out_loss": asdict(trained.held_out),
    }
    return json.dumps(facts, indent=2) + "\n"
