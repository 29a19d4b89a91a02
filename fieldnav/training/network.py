"""The network: a small U-shaped network with residual blocks that draws a heat map of row centres.

Its 88,505 parameters and plain layers keep it within a few milliseconds on one core of the robot's computer.
"""

import torch
from torch import Tensor, nn
from torch.nn import functional

QUARTER, EIGHTH, SIXTEENTH = 28, 36, 40  # channels at these shares of the image's size
HALF = 12
WIDE = 2  # dilation of the coarse blocks, which see rows over a large part of the image
UPSCALE = 2  # the heat is computed at a quarter and unfolded to half the image's size


class Residual(nn.Module):
    """x + conv(x), rectified; keeps shape (n, channels, h, w)."""

    def __init__(self, channels: int, dilation: int = 1) -> None:
        super().__init__()
        self.change = _convolution(channels, channels, dilation=dilation)

    def forward(self, features: Tensor) -> Tensor:
        return functional.relu(features + self.change(features))


class RowNetwork(nn.Module):
    """Logits of the heat and of "this is a field of rows" from normalised images."""

    def __init__(self) -> None:
        super().__init__()
        self.quarter = nn.Sequential(
            _halved(3, HALF), _halved(HALF, QUARTER), Residual(QUARTER), Residual(QUARTER)
        )
        self.eighth = nn.Sequential(_halved(QUARTER, EIGHTH), Residual(EIGHTH, WIDE))
        self.sixteenth = nn.Sequential(_halved(EIGHTH, SIXTEENTH), Residual(SIXTEENTH, WIDE))
        self.to_eighth, self.merged_eighth = nn.Conv2d(SIXTEENTH, EIGHTH, 1), Residual(EIGHTH)
        self.to_quarter, self.merged_quarter = nn.Conv2d(EIGHTH, QUARTER, 1), Residual(QUARTER)
        self.heat = nn.Conv2d(QUARTER, UPSCALE**2, 3, padding=1)
        self.field = nn.Linear(2 * SIXTEENTH, 1)

    def forward(self, images: Tensor) -> tuple[Tensor, Tensor]:
        """Heat, shape (n, 1, h / 2, w / 2), and field, shape (n, 1), of images (n, 3, h, w)."""
        quarter = self.quarter(images)
        eighth = self.eighth(quarter)
        sixteenth = self.sixteenth(eighth)
        field = self.field(torch.cat([sixteenth.mean((2, 3)), sixteenth.amax((2, 3))], 1))
        merged = self.merged_eighth(eighth + _doubled(self.to_eighth(sixteenth)))
        merged = self.merged_quarter(quarter + _doubled(self.to_quarter(merged)))
        return functional.pixel_shuffle(self.heat(merged), UPSCALE), field


def parameter_count(network: nn.Module) -> int:
    """How many numbers training sets."""
    return sum(parameter.numel() for parameter in network.parameters())


def _convolution(inputs: int, outputs: int, stride: int = 1, dilation: int = 1) -> nn.Sequential:
    convolution = nn.Conv2d(
        inputs, outputs, 3, stride=stride, padding=dilation, dilation=dilation, bias=False
    )
    return nn.Sequential(convolution, nn.BatchNorm2d(outputs))


def _halved(inputs: int, outputs: int) -> nn.Sequential:
    return nn.Sequential(*_convolution(inputs, outputs, stride=2), nn.ReLU(inplace=True))


def _doubled(features: Tensor) -> Tensor:
    return functional.interpolate(features, scale_factor=2.0, mode="bilinear")
