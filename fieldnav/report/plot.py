"""A run over time as one picture: states, offset, heading, confidence, speed, rows counted; stops marked."""

from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter

from fieldnav.errors import FieldnavError
from fieldnav.inquiry.outcome import overview
from fieldnav.journal.directory import RunDirectory
from fieldnav.journal.files import check_replaceable, whole_file
from fieldnav.journal.phases import INK, PHASE_COLOURS
from fieldnav.report.composing import stretches
from fieldnav.report.curves import Panel, driving_panels, panel_range
from fieldnav.report.material import Material, Problems, gather, open_recording
from fieldnav.report.scale import minutes
from fieldnav.report.spans import Span, seconds_by_phase
from fieldnav.report.stops import Kind, Stop
from fieldnav.settings.one_line import one_line

WIDTH_INCH, STRIP_INCH, PANEL_INCH, FRAME_INCH, DOTS_PER_INCH = 13.0, 0.34, 1.25, 1.3, 120
SALT = "fieldnav"
"""Makes the names inside an SVG the same every time."""
STOP_COLOUR = PHASE_COLOURS["Fault"]
WITHOUT_RECORDING = "no recording: only what the journal says at its lines"
"""Said in the picture."""


def write_plot(directory: RunDirectory, path: Path) -> list[str]:
    """Draw a run into a PNG or SVG file, by its ending; returns what a person should know of it.

    Raises FieldnavError for an unreadable journal, OutputError.
    """
    check_replaceable(path)
    problems = Problems()
    with open_recording(directory, problems) or nullcontext() as recording:
        material = gather(directory, recording, problems)
    if not material.readable:
        raise FieldnavError(material.problems[0])
    figure = plot_of(material)
    metadata = {"Date": None} if path.suffix.lower() == ".svg" else {"Software": None}
    with whole_file(path) as beside, mpl.rc_context({"svg.hashsalt": SALT, "svg.fonttype": "none"}):
        figure.savefig(beside, dpi=DOTS_PER_INCH, metadata=metadata)
    return problems.said if material.recorded else [*problems.said, WITHOUT_RECORDING]


def plot_of(material: Material) -> Figure:
    """The picture."""
    spans, stops, end_s = stretches(material)
    panels = driving_panels(material)
    heights = [STRIP_INCH, *(PANEL_INCH for _ in panels)]
    figure = Figure(figsize=(WIDTH_INCH, sum(heights) + FRAME_INCH), layout="constrained")
    FigureCanvasAgg(figure)
    rows = figure.subplots(len(heights), 1, sharex=True, squeeze=False, height_ratios=heights)[:, 0]
    begin_s = min((span.from_s for span in spans), default=0.0)
    rows[0].set_xlim(begin_s, max(end_s, begin_s + 1.0))
    _strip(rows[0], spans)
    for axes, panel in zip(rows[1:], panels, strict=True):
        _panel(axes, panel)
    for axes in rows:
        _mark(axes, stops)
    rows[-1].xaxis.set_major_formatter(FuncFormatter(lambda at, _: minutes(at)))
    rows[-1].set_xlabel("time, minutes:seconds", fontsize=9.5)
    _head(figure, material, spans)
    return figure


def _strip(axes: Axes, spans: Sequence[Span]) -> None:
    """The states, and where each lane begins."""
    axes.set_yticks([])
    axes.spines[:].set_visible(False)
    axes.set_ylim(0, 1)
    axes.tick_params(bottom=False)
    for span in spans:
        axes.axvspan(span.from_s, span.to_s, color=PHASE_COLOURS[span.phase], linewidth=0)
    first: dict[int, float] = {}
    for span in spans:
        if span.lane is not None:
            first.setdefault(span.lane, span.from_s)
    for lane, from_s in first.items():
        axes.annotate(f"lane {lane}", (from_s, 1), (1, 3), textcoords="offset points", fontsize=9, color=INK)


def _panel(axes: Axes, panel: Panel) -> None:
    for curve in panel.curves:
        style = {"linestyle": "", "marker": "o", "markersize": 3.5} if curve.dotted else {"linewidth": 1.1}
        axes.plot(curve.time_s, curve.values, color=curve.colour, label=curve.label, **style)
    axes.set_ylabel(panel.title, fontsize=9.5)
    axes.set_ylim(panel_range(panel))
    axes.grid(color="#e4e8eb", linewidth=0.7)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=9)
    if len(panel.curves) > 1:
        axes.legend(
            fontsize=8.5,
            frameon=False,
            borderaxespad=0.0,
            loc="lower right",
            bbox_to_anchor=(1.0, 0.98),
            ncols=len(panel.curves),
        )


def _mark(axes: Axes, stops: Sequence[Stop]) -> None:
    """Stops and pauses as lines, holds as fainter ones."""
    for stop in stops:
        if stop.kind is not Kind.NOTE:
            faint = 0.4 if stop.kind is Kind.HOLD else 1.0
            axes.axvline(stop.line.stamp_s, color=STOP_COLOUR, linewidth=1.2, linestyle="--", alpha=faint)


def _head(figure: Figure, material: Material, spans: Sequence[Span]) -> None:
    ended = overview(material.directory)
    title = one_line(f"{ended.run}: {ended.outcome.value}")
    figure.suptitle(title, x=0.01, ha="left", fontsize=12.5, weight="bold", color=INK, parse_math=False)
    if not material.recorded:
        figure.text(0.99, 0.99, WITHOUT_RECORDING, ha="right", va="top", fontsize=10, color=INK)
    handles = [Patch(color=PHASE_COLOURS[phase], label=phase.lower()) for phase in seconds_by_phase(spans)]
    if handles:
        figure.legend(
            handles=handles, loc="outside lower center", ncols=len(handles), frameon=False, fontsize=9
        )
