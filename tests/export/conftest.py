import pytest
from small_cabinet import doubled_sheet, make_cabinet, painted_cube


@pytest.fixture(scope="session")
def cabinet():
    return make_cabinet()


@pytest.fixture(scope="session")
def make_cube():
    return painted_cube


@pytest.fixture(scope="session")
def sheet():
    return doubled_sheet()
