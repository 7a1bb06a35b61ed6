"""Stubs against the module, and strict types of package, tests and notebooks."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

PYTHON = Path(__file__).resolve().parents[1]


def run(*arguments: str | Path) -> None:
    line = [sys.executable, *map(str, arguments)]
    done = subprocess.run(line, capture_output=True, text=True, cwd=PYTHON)
    assert done.returncode == 0, done.stdout + done.stderr


def test_stubs_are_those_of_the_module() -> None:
    pytest.importorskip("mypy")
    run("-m", "mypy.stubtest", "voussoir._core", "--mypy-config-file", "pyproject.toml")


def test_the_package_and_the_notebooks_are_strictly_typed(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    files: list[str | Path] = []
    for notebook in sorted((PYTHON / "notebooks").glob("*.ipynb")):
        cells = json.loads(notebook.read_text())["cells"]
        code = "\n".join("".join(c["source"]) for c in cells if c["cell_type"] == "code")
        file = tmp_path / f"notebook_{notebook.stem.replace('-', '_')}.py"
        file.write_text(code + "\n")
        files.append(file)
    config = ["--config-file", PYTHON / "pyproject.toml", "--cache-dir", tmp_path / "cache"]
    run("-m", "mypy", *config, "package/voussoir", "package/compas_voussoir")
    assert len(files) == 6
    run("-m", "mypy", *config, *files)
