from datetime import UTC, datetime
from pathlib import Path

import pytest

from fieldnav.preflight.computer import Computer


@pytest.fixture
def computer() -> Computer:
    """One that is well."""
    return Computer(
        runs=Path("runs"),
        free_bytes=50_000_000_000,
        refusal="",
        utc=datetime(2026, 6, 1, 9, 30, tzinfo=UTC),
        installed=datetime(2026, 5, 1, tzinfo=UTC),
        tick_s=1e-9,
        synchronised=True,
        load=0.5,
        processors=2,
    )
