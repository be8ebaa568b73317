"""The description on PyPI has no relative links: they would lead nowhere there."""

import importlib.util
import re
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parent.parent


@pytest.fixture
def hook(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    interface = ModuleType("hatchling.metadata.plugin.interface")
    interface.MetadataHookInterface = type("MetadataHookInterface", (), {"root": str(ROOT)})  # type: ignore[attr-defined]
    for name in ("hatchling", "hatchling.metadata", "hatchling.metadata.plugin"):
        monkeypatch.setitem(sys.modules, name, ModuleType(name))
    monkeypatch.setitem(sys.modules, interface.__name__, interface)
    spec = importlib.util.spec_from_file_location("pypi_readme", ROOT / "scripts" / "pypi_readme.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_links_are_absolute_where_the_repository_is_stated(hook: ModuleType) -> None:
    found = hook.for_pypi("![A](docs/a.png) [b](docs/b.md#c) [d](https://x.org) [e](#f)", "https://x.org/o/n/")
    assert found == (
        "![A](https://x.org/o/n/raw/HEAD/docs/a.png) [b](https://x.org/o/n/blob/HEAD/docs/b.md#c) "
        "[d](https://x.org) [e](#f)"
    )


@pytest.mark.parametrize(
    ("remote", "address"),
    [
        ("https://example.org/owner/grafu.git", "https://example.org/owner/grafu"),
        ("https://someone:secret@example.org/owner/grafu", "https://example.org/owner/grafu"),
        ("git@example.org:owner/grafu.git\n", "https://example.org/owner/grafu"),
        ("ssh://git@example.org:22/group/owner/grafu.git", "https://example.org/group/owner/grafu"),
        ("/srv/git/grafu.git", ""),
        ("../grafu", ""),
        ("file:///srv/git/grafu.git", ""),
        ("", ""),
    ],
)
def test_the_repository_is_the_address_of_the_remote(hook: ModuleType, remote: str, address: str) -> None:
    assert hook.repository_at(remote) == address


@pytest.mark.parametrize("remote", ["git@example.org:owner/grafu.git", ""], ids=["a remote", "no remote"])
def test_no_link_on_pypi_is_broken(hook: ModuleType, remote: str, monkeypatch: pytest.MonkeyPatch) -> None:
    metadata: dict[str, dict[str, str]] = {}
    monkeypatch.setattr(hook, "_origin", lambda root: remote)
    hook.ReadmeHook().update(metadata)
    text = metadata["readme"]["text"]
    assert re.findall(r"\]\((?!https?://|#)", text) == []
    assert ("![" in text) == bool(remote)
    assert text.startswith("# GraFu")
    assert ("Repository" in metadata["urls"]) == bool(remote)
    assert all(address.startswith("https://") for address in metadata["urls"].values())


def test_without_a_clone_no_repository_is_stated(hook: ModuleType, tmp_path: Path) -> None:
    assert hook._origin(tmp_path) == ""
