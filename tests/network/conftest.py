"""One thread for all tests of the network."""

import pytest


@pytest.fixture(autouse=True)
def _alone(one_thread: None) -> None: ...
