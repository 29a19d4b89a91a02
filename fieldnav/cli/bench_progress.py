"""How far a benchmark is: a bar on standard error for each of its parts."""

from types import TracebackType

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TaskID, TextColumn, TimeRemainingColumn

from fieldnav.cli.console import watching


class PartBars:
    """One bar a part, in the order they begin; gone when the benchmark ends."""

    def __init__(self) -> None:
        self._bars = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
            console=watching(),
            transient=True,
        )
        self._parts: dict[str, TaskID] = {}

    def __enter__(self) -> "PartBars":
        self._bars.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bars.stop()

    def tell(self, part: str, done: int, steps: int) -> None:
        """Take in how far a part is; see `fieldnav.evaluation.benchmark.Progress`."""
        if part not in self._parts:
            self._parts[part] = self._bars.add_task(part, total=steps)
        self._bars.update(self._parts[part], completed=done, total=steps)
