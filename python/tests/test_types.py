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


def test_misspelt_keys_and_values_are_type_errors(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    mistakes = [
        "voussoir.Arch(radius=1, thicknes=0.1, thickness=0.1, depth=1, voussoirs=9)",
        'voussoir.Arch(radius=1, thickness=0.1, depth=1, voussoirs=9, profile="gothic")',
        "voussoir.Scene().joint(frction=0.5)",
        'voussoir.assess("a.json").verdic',
        'voussoir.kinematic("a.json").alpha0.valu',
    ]
    file = tmp_path / "mistakes.py"
    file.write_text("\n".join(["import voussoir", *mistakes]) + "\n")
    line = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), str(file)]
    told = subprocess.run(line, capture_output=True, text=True, cwd=tmp_path).stdout
    assert [n for n in range(2, 7) if f"mistakes.py:{n}: error" in told] == [2, 3, 4, 5, 6], told
