from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def made():
    """A cabinet that was made and made to work, with a part whose name is an attack."""
    from made_models import made_model

    return made_model()


@pytest.fixture(scope="session")
def page(made) -> str:
    from made_models import page_of

    return page_of(made)


@pytest.fixture(scope="session")
def page_file(page: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "report.html"
    path.write_text(page)
    return path
