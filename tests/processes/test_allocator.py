"""Memory that is freed is kept where glibc is asked to keep it, so that the next block costs no page faults."""

import platform
import subprocess
import sys

import pytest

from grafu.processes.allocator import keep_freed_memory

_BLOCKS, _SIZE, _PAGE = 8, 48 << 20, 4096
_FAULTS = f"""
import resource, sys
from grafu.processes.allocator import keep_freed_memory
if sys.argv[1] == "keep":
    assert keep_freed_memory()
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
for _ in range({_BLOCKS}):
    bytes(b"x") * {_SIZE}
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="only glibc's malloc is asked")
def test_a_block_that_follows_a_freed_one_causes_no_page_faults() -> None:
    kept, usual = (_faults(how) for how in ("keep", "as it is"))
    assert usual > 2 * kept
    assert kept < 1.2 * _SIZE / _PAGE  # the first block's pages, and few others


def _faults(how: str) -> int:
    return int(subprocess.run([sys.executable, "-c", _FAULTS, how], check=True, capture_output=True, text=True).stdout)


def test_without_such_a_function_nothing_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ctypes.CDLL", lambda name: object())
    assert not keep_freed_memory()
