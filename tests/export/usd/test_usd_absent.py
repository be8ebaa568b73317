import pytest

from grafu.errors import ExportError
from grafu.export.formats import exporter_for
from grafu.export.usd import exporter


@pytest.mark.parametrize("name", ["usd", "usdz"])
def test_without_openusd_it_says_what_to_install(name, monkeypatch):
    monkeypatch.setattr(exporter, "find_spec", lambda package: None)
    with pytest.raises(ExportError, match=r"pip install 'grafu\[usd\]'"):
        exporter_for(name)
