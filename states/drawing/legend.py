"""Above the painted diagram: which run it is, how it ended, and what colours and widths mean."""

from collections.abc import Iterator
from html import escape

from states.drawing.paint import TIMES, Paint, clock, shade, width

HEAD = 92.0
"""Height of the strip above the diagram."""
LEFT, NAME_Y, OUTCOME_Y, REASON_Y = 24.0, -60.0, -36.0, -16.0
NAME_SIZE = 19.0
MOST_LETTERS = 180
"""Of the reason, in one line."""
SHARES = (0.01, 0.05, 0.2, 0.5, 1.0)
"""Of a run's time, that the legend shows."""
SWATCH, SWATCH_HEIGHT, LEGEND_Y, WORDS_Y = 44.0, 18.0, -70.0, -38.0
SAMPLES = (1, 4, 16)
"""Numbers of transitions whose widths it shows."""
SAMPLE_FROM, SAMPLE_EVERY, SAMPLE_LENGTH = 250.0, 64.0, 36.0
LEGEND_WIDTH = SAMPLE_FROM + len(SAMPLES) * SAMPLE_EVERY + 24.0


def heading(paint: Paint) -> Iterator[str]:
    """The run's name, how it ended after how long, and why."""
    outcome, reason = f"{paint.outcome} · {clock(paint.seconds)} in all", paint.reason
    if paint.unknown:
        outcome += f" · transitions that this version does not have: {paint.unknown}"
    if len(reason) > MOST_LETTERS:
        reason = f"{reason[: MOST_LETTERS - 1]}…"
    place = f'x="{LEFT:g}" y="{NAME_Y:g}" style="font-size:{NAME_SIZE:g}px"'
    yield f'<text class="name" {place}>{escape(paint.name)}</text>'
    yield f'<text x="{LEFT:g}" y="{OUTCOME_Y:g}">{escape(outcome)}</text>'
    if reason:
        yield f'<text x="{LEFT:g}" y="{REASON_Y:g}">{escape(reason)}</text>'


def legend(wide: float) -> Iterator[str]:
    """Right above: the colours' shares of the run's time, the arrows' numbers of transitions."""
    left = wide - LEGEND_WIDTH
    for index, share in enumerate(SHARES):
        x = left + index * SWATCH
        fill = f'fill="{shade(share**0.5)}" stroke="#b0bec5"'
        yield f'<rect x="{x:g}" y="{LEGEND_Y:g}" width="{SWATCH:g}" height="{SWATCH_HEIGHT:g}" {fill}/>'
        yield _small(x + SWATCH / 2, LEGEND_Y - 4, f"{share:.0%}")
    yield _small(left + len(SHARES) * SWATCH / 2, WORDS_Y, "share of the run's time")
    for index, count in enumerate(SAMPLES):
        x, y = left + SAMPLE_FROM + index * SAMPLE_EVERY, LEGEND_Y + SWATCH_HEIGHT / 2
        stroke = f'stroke="#37474f" stroke-width="{width(count):.2g}"'
        yield f'<path d="M{x:g} {y:g}h{SAMPLE_LENGTH:g}" {stroke}/>'
        yield _small(x + SAMPLE_LENGTH / 2, LEGEND_Y - 4, f"{TIMES}{count}")
    middle = left + SAMPLE_FROM + (len(SAMPLES) - 1) * SAMPLE_EVERY / 2 + SAMPLE_LENGTH / 2
    yield _small(middle, WORDS_Y, "times taken; pale: never")


def _small(x: float, y: float, words: str) -> str:
    return f'<text class="time" x="{x:g}" y="{y:g}" text-anchor="middle">{escape(words)}</text>'
