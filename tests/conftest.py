"""Settings for all tests; it also makes tests/ importable, so that every test can use `strategies` and `sweeping`."""

import os

import pytest
from hypothesis import HealthCheck, settings

settings.register_profile("grafu", deadline=None, suppress_health_check=[HealthCheck.too_slow])
# The build server draws the same examples every time: a red run is the change's doing. At home every run draws anew.
settings.register_profile("server", settings.get_profile("grafu"), derandomize=True)
settings.load_profile("server" if os.environ.get("CI") else "grafu")


def pytest_configure(config: pytest.Config) -> None:
    # The shape checks sample long tuples with `random`, also inside strategies; Hypothesis seeds it, so tests repeat
    config.addinivalue_line("filterwarnings", "ignore:Do not use the `random` module inside strategies")
