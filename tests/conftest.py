"""Settings for all tests; it also makes tests/ importable, so that every test can use `strategies` and `sweeping`."""

import os
import signal
from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, settings

from shape_checks import use_in_import_hook

if TYPE_CHECKING:
    from chromium import Chromium

use_in_import_hook()

settings.register_profile("anew", deadline=None, suppress_health_check=[HealthCheck.too_slow])
# The same examples every time: a red run is the change's doing. HYPOTHESIS_PROFILE=anew draws others, to look for more.
settings.register_profile("same", settings.get_profile("anew"), derandomize=True)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "same"))


def pytest_configure(config: pytest.Config) -> None:
    # The shape checks sample long tuples with `random`, also inside strategies; Hypothesis seeds it, so tests repeat
    config.addinivalue_line("filterwarnings", "ignore:Do not use the `random` module inside strategies")
    # Else every program that a test starts compiles all modules again
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    # Started in the background of a script, tests ignore SIGINT, and so would the programs that they start to interrupt
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    # Where tests run in several processes, a slow one that starts last leaves the others idle; else the order is kept
    items.sort(key=lambda item: item.get_closest_marker("slow") is None)


# The fixtures import what they need when they are asked for: what is imported earlier escapes the shape checks


@pytest.fixture(scope="module")
def remembered() -> Iterator[None]:
    """Streams, writers and training take their specimens from `remembered`, where each is made once a process."""
    from remembered import remember

    with pytest.MonkeyPatch.context() as patch:
        remember(patch)
        yield


@pytest.fixture
def one_thread() -> Iterator[None]:
    """Torch computes with one thread: tests of small networks run beside others."""
    import torch  # noqa: TID251  # only tests of network and training ask for this

    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="session")
def browser() -> Iterator["Chromium"]:
    """A headless Chromium that tests share."""
    from chromium import Chromium, chromium_path

    path = chromium_path()
    if path is None:
        pytest.skip("no Chromium here")
    try:
        browser = Chromium(path)
    except (AssertionError, OSError) as error:
        pytest.skip(f"Chromium does not start: {error}")
    yield browser
    browser.close()
