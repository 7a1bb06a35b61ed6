"""The examples of the package's pages run as they stand."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

import pytest
import voussoir
from conftest import ROOT


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


def test_the_docstring_of_the_package() -> None:
    assert doctest.testmod(voussoir).attempted > 0 and doctest.testmod(voussoir).failed == 0


def test_everything_public_is_documented() -> None:
    for name in voussoir.__all__:
        thing = getattr(voussoir, name)
        assert thing.__doc__ or name.startswith("__"), name
        for key, value in vars(thing).items() if isinstance(thing, type) else ():
            if callable(value) or isinstance(value, property):
                documented = getattr(value, "__doc__", None)
                assert key.startswith("_") or documented, f"{name}.{key}"
