"""What the package is made of."""

from __future__ import annotations

import re
from importlib import metadata
from pathlib import Path

import hyperstat as hs

ROOT = Path(__file__).resolve().parents[3]


def versions(lock: Path) -> dict[str, set[str]]:
    """Versions in a lock file, by package."""
    found: dict[str, set[str]] = {}
    pattern = r'\[\[package\]\]\nname = "([^"]+)"\nversion = "([^"]+)"'
    for name, version in re.findall(pattern, lock.read_text()):
        found.setdefault(name, set()).add(version)
    return found


def test_versions_are_those_of_the_workspace() -> None:
    """Else what the workspace has built is built again: `cp Cargo.lock crates/python`, `cargo update -w`."""
    workspace = versions(ROOT / "Cargo.lock")
    for lock in ("crates/python/Cargo.lock", "crates/web/Cargo.lock", "benches/python/core/Cargo.lock"):
        own = versions(ROOT / lock)
        shared = own.keys() & workspace.keys()
        assert len(shared) > 50
        assert [name for name in sorted(shared) if not own[name] <= workspace[name]] == [], lock


def test_the_version_is_the_workspaces() -> None:
    workspace = (ROOT / "Cargo.toml").read_text()
    version = re.search(r'^version = "([^"]+)"', workspace, re.MULTILINE)
    assert version and hs.__version__ == version[1] == metadata.version("hyperstat")


def test_profiles_are_the_workspaces() -> None:
    def profile(path: Path) -> list[str]:
        return path.read_text().split("[profile.release]\n")[1].splitlines()

    assert profile(ROOT / "crates/python/Cargo.toml") == profile(ROOT / "Cargo.toml")


def test_licences_go_along() -> None:
    """In the wheel too, which takes no file from above."""
    named = re.findall(r'license-files = \[(.*)\]', (ROOT / "crates/python/pyproject.toml").read_text())
    assert named == ['"LICENSE-APACHE", "LICENSE-MIT"']
    for name in ("LICENSE-APACHE", "LICENSE-MIT"):
        assert (ROOT / "crates/python" / name).read_bytes() == (ROOT / name).read_bytes()
    installed = {path.name for path in metadata.files("hyperstat") or []}
    assert {"LICENSE-APACHE", "LICENSE-MIT"} <= installed


def test_the_readme_holds_outside_the_repository() -> None:
    text = (ROOT / "crates/python/README.md").read_text(encoding="utf-8")
    assert [link for link in re.findall(r"\]\(([^)]*)\)", text) if not link.startswith("http")] == []


def test_one_wheel_serves_all_versions() -> None:
    tags = metadata.distribution("hyperstat").read_text("WHEEL") or ""
    assert "cp310-abi3" in tags
    assert metadata.requires("hyperstat") is not None
    assert (Path(hs.__file__).parent / "py.typed").is_file()
