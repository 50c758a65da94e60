"""What the tests share: the repository's files, and its command line."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def root() -> Path:
    """The repository."""
    return ROOT


@pytest.fixture(scope="session")
def examples() -> Path:
    return ROOT / "examples"


@pytest.fixture(scope="session")
def binary() -> Path:
    """The command line, to compare with."""
    path = Path(os.environ.get("HYPERSTAT", ROOT / "target" / "release" / "hyperstat"))
    if not path.is_file():
        pytest.fail(f"{path} is missing: build it by `cargo build --release`, or name it in HYPERSTAT")
    return path
