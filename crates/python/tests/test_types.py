"""The stubs are those of the module, and examples are typed."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import hyperstat as hs

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = sorted((ROOT / "examples" / "python").glob("*.py"))
NOTEBOOKS = sorted((ROOT / "examples" / "python").glob("*.ipynb"))


def code(notebook: Path) -> list[str]:
    """What a notebook's cells of code hold."""
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


def checked(*command: str, cwd: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", *command], cwd=cwd, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_stubs_are_those_of_the_module(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    checked("mypy.stubtest", "hyperstat._hyperstat", cwd=tmp_path)


def test_the_package_and_the_examples_are_typed(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    (tmp_path / "mypy.ini").write_text(
        "[mypy]\nstrict = true\n"
        "[mypy-matplotlib.*,pandas.*,pyarrow.*,xarray.*,pyvista.*,tqdm.*,scipy.*,pymoo.*,optuna.*,distributed.*]\n"
        "ignore_missing_imports = true\nfollow_imports = skip\n"
    )
    checked("mypy", "-p", "hyperstat", cwd=tmp_path)
    checked("mypy", *map(str, EXAMPLES), cwd=tmp_path)
    for path in NOTEBOOKS:
        own = tmp_path / f"{path.stem}.py"
        own.write_text("\n".join(code(path)), encoding="utf-8")
    checked("mypy", *(f"{path.stem}.py" for path in NOTEBOOKS), cwd=tmp_path)
    # The lines of both READMEs, as they stand there.
    for name in ("README.md", "crates/python/README.md"):
        found = re.findall(r"```python\n(.*?)```", (ROOT / name).read_text(encoding="utf-8"), re.DOTALL)
        assert found
        for lines in found:
            (tmp_path / "lines.py").write_text(lines, encoding="utf-8")
            checked("mypy", "lines.py", cwd=tmp_path)


@pytest.mark.parametrize("path", EXAMPLES, ids=[path.stem for path in EXAMPLES])
def test_examples_run(path: Path, tmp_path: Path) -> None:
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    done = subprocess.run(
        [sys.executable, path],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_notebooks_run(path: Path, tmp_path: Path) -> None:
    """As they stand, without outputs, and with what they say of their numbers (their `assert`)."""
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    for cell in notebook.cells:
        assert not cell.get("outputs") and cell.get("execution_count") is None
    nbclient.NotebookClient(
        notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}
    ).execute()
    assert any(cell.get("outputs") for cell in notebook.cells)


def test_everything_public_is_documented() -> None:
    for name in hs.__all__:
        own = getattr(hs, name)
        if isinstance(own, type):
            assert own.__doc__, name
            for member, value in vars(own).items():
                if not member.startswith("_") and callable(value):
                    assert value.__doc__, f"{name}.{member}"
