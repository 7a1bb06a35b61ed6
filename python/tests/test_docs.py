"""The examples of pages and docstrings run as they stand; `help()` says all there is to know."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
import pydoc
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import voussoir
from conftest import ROOT

PUBLIC = [name for name in voussoir.__all__ if name not in ("__version__", "compas")]
FUNCTIONS = [name for name in PUBLIC if inspect.isfunction(getattr(voussoir, name))]
MODULES = [m.name for m in pkgutil.iter_modules(voussoir.__path__)]
MODULES = [name for name in MODULES if name not in ("_core", "__main__")]


def blocks(page: Path) -> list[str]:
    return re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


@pytest.mark.parametrize("page", ["python/README.md", "docs/python.md"])
def test_examples(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = blocks(ROOT / page)
    assert found
    monkeypatch.chdir(tmp_path)
    voussoir.load(ROOT / "structures" / "oppenheim-arch.json").save("arch.json")
    for block in found:
        values: dict[str, object] = {}
        exec(compile(block, page, "exec"), values)
        if "tilt" in values:
            tilt = values["tilt"]
            assert isinstance(tilt, voussoir.Tilt) and tilt.tilt_deg.value is not None
            assert f"{tilt.tilt_deg.value:.2f}" == "21.80"


@pytest.mark.parametrize("module", ["", *MODULES])
def test_examples_of_docstrings(module: str) -> None:
    if module == "compas":
        pytest.importorskip("compas_assembly")
        pytest.importorskip("compas_dem")
    name = f"voussoir.{module}".rstrip(".")
    assert doctest.testmod(importlib.import_module(name)).failed == 0


@pytest.mark.parametrize("name", PUBLIC)
def test_every_public_name_has_an_example(name: str) -> None:
    doc = inspect.getdoc(getattr(voussoir, name)) or ""
    assert "\nExamples\n--------\n" in doc and ">>> " in doc, name


def functions() -> list[Callable[..., Any]]:
    from voussoir import compas

    of_compas = [getattr(compas, name) for name in compas.__all__]
    return [*(getattr(voussoir, name) for name in FUNCTIONS), *of_compas]


@pytest.mark.parametrize("function", functions(), ids=lambda f: str(f.__name__))
def test_functions_say_what_they_take_return_and_raise(function: Callable[..., Any]) -> None:
    doc = inspect.getdoc(function) or ""
    for section in ("Parameters", "Returns", "Raises", "Examples"):
        assert f"\n{section}\n{'-' * len(section)}\n" in doc, (function.__name__, section)
    # The page that explains it is there.
    pages = re.findall(r"``(docs/\S+\.md)``", doc)
    assert all((ROOT / page).is_file() for page in pages)
    assert pages or function.__module__ == "voussoir.compas", function.__name__
    parameters = doc.split("\nParameters\n")[1].split("\nReturns\n")[0]
    named = re.findall(r"^(\**\w+(?:, \w+)*)(?: :|$)", parameters, re.MULTILINE)
    told = {word.strip("*") for words in named for word in words.split(", ")}
    assert told == set(inspect.signature(function).parameters), function.__name__


@pytest.mark.parametrize("name", PUBLIC)
def test_everything_that_a_class_shows_is_documented(name: str) -> None:
    thing = getattr(voussoir, name)
    for key, value in inspect.getmembers(thing) if isinstance(thing, type) else ():
        if not key.startswith("_") and (callable(value) or isinstance(value, property)):
            doc = inspect.getdoc(value)
            assert doc and doc != inspect.getdoc(type(value)), f"{name}.{key}"
    keys = inspect.get_annotations(thing) if isinstance(thing, type) else {}
    keys = [key for key in keys if not key.startswith("_") and key != "question"]
    doc = inspect.getdoc(thing) or ""
    assert all(re.search(rf"^(?:\w+, )*{key}(?:, \w+)* : ", doc, re.MULTILINE) for key in keys), name


def test_help_is_a_tour() -> None:
    text = pydoc.plain(pydoc.render_doc(voussoir))
    for name in PUBLIC:
        assert re.search(rf"\b{name}\b", text), name
    questions = ["assess", "limit", "tilt", "critical", "thrust", "settle", "push", "simulate", "sweep"]
    tour = inspect.getdoc(voussoir) or ""
    assert all(f":func:`{question}`" in tour for question in questions)


def test_generated_classes_are_those_of_the_schema() -> None:
    line = [sys.executable, str(ROOT / "python" / "generate.py"), "--check"]
    done = subprocess.run(line, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
