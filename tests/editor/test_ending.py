"""How a session of `grafu edit` ends."""

import signal
import subprocess
import sys

import pytest


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 0), (signal.SIGTERM, 143)])
def test_the_usual_end_and_an_asked_one_are_no_interruption(model, tmp_path, number, code):
    command = [sys.executable, "-m", "grafu", "edit", str(model), "--out", str(tmp_path / "out"), "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert "http://127.0.0.1:" in process.stdout.readline()
        assert "Ctrl-C ends it" in process.stdout.readline()
        process.send_signal(number)
        said, complained = process.communicate(timeout=120)
    assert process.returncode == code
    assert said == "ended; every choice is saved\n"
    assert complained == ""
