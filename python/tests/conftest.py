"""What tests share: the scenes of the repository."""

from __future__ import annotations

from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
STRUCTURES = ROOT / "structures"


@pytest.fixture
def structures() -> Path:
    return STRUCTURES
