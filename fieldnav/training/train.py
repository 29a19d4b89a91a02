"""The training itself: by a budget of minutes, on the CPU, while the pool is still being drawn."""

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import torch
from torch import Tensor, nn, optim
from torch.nn import functional

from fieldnav.training.batches import TrainingBatch, TrainingPictures, plain_batches
from fieldnav.training.network import RowNetwork
from fieldnav.training.pool import Chunk, Drawers, Pool

PEAK_RATE = 3e-3
WARM_UP_STEPS = 200
MIN_RATE = 0.005  # of the peak, at the first and the last step
WEIGHT_DECAY = 1e-3
MAX_GRADIENT = 1.0
ROW_WEIGHT = 1.5  # a row's centre weighs 1 + this: its pixels are fewer than those between
FIELD_WEIGHT = 0.1  # of the second output in the loss
FIELD_FROM_PX = 20  # heat rows above this one do not make a field: the far part of a landscape
ROW_HEAT, FIELD_ROWS = 0.5, 0.004  # a field shows rows on at least this share of its pixels

MIN_CHUNKS = 5  # training begins with; fewer pictures would be learnt by heart
WAIT_S = 2.0
RELOAD_S = 60.0  # how often new chunks are looked for
PROGRESS_S = 30.0
RECENT_STEPS = 200  # over which the losses are averaged
MINUTE_S = 60.0

Report = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Loss:
    """Cross-entropies: of the heat per weighted pixel, and of the field per picture."""

    heat: float
    field: float

    def __str__(self) -> str:
        return f"heat {self.heat:.4f}, field {self.field:.4f}"


@dataclass(frozen=True, slots=True)
class Trained:
    """A trained network, how it was trained and how good it is."""

    network: RowNetwork
    steps: int
    pictures: int
    training: Loss
    held_out: Loss


class Trainer:
    """A network with its optimiser and the losses of its latest steps."""

    def __init__(self) -> None:
        self.network = RowNetwork()
        self.steps = 0
        self._optimiser = optim.AdamW(self.network.parameters(), lr=PEAK_RATE, weight_decay=WEIGHT_DECAY)
        self._recent: deque[tuple[float, float]] = deque(maxlen=RECENT_STEPS)

    def step(self, batch: TrainingBatch, progress: float) -> None:
        """Learn from a batch; `progress` from 0 to 1 sets the learning rate."""
        for group in self._optimiser.param_groups:
            group["lr"] = learning_rate(self.steps, progress)
        heat, field = losses(self.network, batch)
        self._optimiser.zero_grad()
        (heat + FIELD_WEIGHT * field).backward()
        nn.utils.clip_grad_norm_(self.network.parameters(), MAX_GRADIENT)
        self._optimiser.step()
        self.steps += 1
        self._recent.append((heat.item(), field.item()))

    @property
    def loss(self) -> Loss:
        """Mean of the latest steps."""
        return _mean_loss(list(self._recent))


def learning_rate(steps: int, progress: float) -> float:
    """A short warm-up, then half a cosine down to nearly nothing."""
    warm_up = min(1.0, steps / WARM_UP_STEPS + MIN_RATE * 2)
    return float(PEAK_RATE * warm_up * ((1 + np.cos(np.pi * progress)) / 2 + MIN_RATE))


def losses(network: RowNetwork, batch: TrainingBatch) -> tuple[Tensor, Tensor]:
    """Loss of the heat over the judged pixels, and of the field."""
    truth, judged = torch.from_numpy(batch.heat), torch.from_numpy(batch.judged)
    heat, field = network(torch.from_numpy(batch.inputs))
    weight = judged * (1 + ROW_WEIGHT * truth)
    per_pixel = functional.binary_cross_entropy_with_logits(heat, truth, reduction="none")
    rows = ((truth * judged)[:, :, FIELD_FROM_PX:] > ROW_HEAT).float().mean((2, 3))
    is_field = (rows > FIELD_ROWS).float()
    return (per_pixel * weight).sum() / weight.sum(), functional.binary_cross_entropy_with_logits(
        field, is_field
    )


def train(pool: Pool, drawers: Drawers, minutes: float, threads: int, report: Report) -> Trained:
    """Train a network from the start; the minutes count from when there are enough pictures."""
    torch.set_num_threads(threads)
    torch.manual_seed(pool.seed)
    pictures = TrainingPictures(np.random.default_rng(pool.seed))
    _wait_for_pictures(pool, drawers, report)
    trainer = Trainer()
    begin_s = loaded_s = reported_s = time.monotonic()
    _take_in(pool, pictures)
    while (now_s := time.monotonic()) < begin_s + minutes * MINUTE_S:
        if now_s > loaded_s + RELOAD_S:
            drawers.check()
            _take_in(pool, pictures)
            loaded_s = now_s
        trainer.step(pictures.next_batch(), (now_s - begin_s) / (minutes * MINUTE_S))
        if now_s > reported_s + PROGRESS_S:
            elapsed = (now_s - begin_s) / MINUTE_S
            report(f"{elapsed:6.1f} min  step {trainer.steps}  {len(pictures)} pictures  {trainer.loss}")
            reported_s = now_s
    trainer.network.eval()
    held_out = held_out_loss(trainer.network, pool.load(pool.held_out))
    return Trained(trainer.network, trainer.steps, len(pictures), trainer.loss, held_out)


def held_out_loss(network: RowNetwork, chunk: Chunk) -> Loss:
    """Mean loss on pictures that were not trained on; the network must be in evaluation mode."""
    with torch.inference_mode():
        found = [losses(network, batch) for batch in plain_batches(chunk)]
    return _mean_loss([(heat.item(), field.item()) for heat, field in found])


def _wait_for_pictures(pool: Pool, drawers: Drawers, report: Report) -> None:
    """Wait until there are enough chunks to train on, and the held-out one."""
    wanted, told = min(MIN_CHUNKS, pool.held_out) + 1, -1
    while len(drawn := pool.drawn()) < wanted or pool.held_out not in drawn:
        drawers.check()
        if len(drawn) != told:
            report(f"drawing: {len(drawn)} of {pool.chunks} chunks; training begins with {wanted}")
            told = len(drawn)
        time.sleep(WAIT_S)


def _take_in(pool: Pool, pictures: TrainingPictures) -> None:
    """Load the chunks drawn since the last time."""
    for number in pool.drawn():
        if number != pool.held_out and number not in pictures:
            pictures.add(number, pool.load(number))


def _mean_loss(values: list[tuple[float, float]]) -> Loss:
    heat, field = np.mean(values, axis=0)
    return Loss(float(heat), float(field))
