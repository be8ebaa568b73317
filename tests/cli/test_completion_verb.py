"""The scripts of `grafu completion` in the shells themselves: what they offer after a word that was begun."""

import os
import re
import shutil
import subprocess
from contextlib import redirect_stdout
from functools import partial
from pathlib import Path
from time import monotonic

import pytest

from grafu.cli.completion import SHELLS
from grafu.cli.main import main
from grafu.export.formats import FORMATS


@pytest.fixture(scope="module")
def scripts(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("scripts")
    for shell in SHELLS:
        with (folder / shell).open("w") as file, redirect_stdout(file):
            assert main(["completion", shell]) == 0
    return folder


def bash(script: Path, place: Path, words: list[str], wanted: set[str]) -> set[str]:  # all at once
    code = (
        f"cd '{place}'; source '{script}'; COMP_WORDS=(grafu {' '.join(map(repr, words))}); COMP_CWORD={len(words)}; "
        "_shtab_grafu; printf '%s\\n' \"${COMPREPLY[@]}\""
    )
    done = subprocess.run(["bash", "--norc", "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


def fish(script: Path, place: Path, words: list[str], wanted: set[str]) -> set[str]:  # all at once
    line = " ".join(["grafu", *words])
    code = f"cd '{place}'; source '{script}'; complete -C '{line}'"
    environment = {**os.environ, "HOME": str(place), "XDG_CONFIG_HOME": str(place / "none")}
    done = subprocess.run(["fish", "-c", code], capture_output=True, text=True, check=True, env=environment)
    return {offered.partition("\t")[0] for offered in done.stdout.splitlines()}


def zsh(script: Path, place: Path, words: list[str], wanted: set[str]) -> set[str]:
    """Types the words and a tab in an interactive zsh, and returns what stands on its terminal when all wanted does."""
    import pty

    pid, terminal = pty.fork()
    if pid == 0:
        os.chdir(place)
        os.execvpe("zsh", ["zsh", "-f", "-i"], {**os.environ, "TERM": "xterm", "COLUMNS": "200", "HOME": str(place)})
    (place / "functions").mkdir(exist_ok=True)
    shutil.copy(script, place / "functions" / "_grafu")
    start = f"PS1=; LISTMAX=500; fpath+={place}/functions; autoload -U compinit; compinit -u -D\n"
    os.write(terminal, (start + "print -n READ; print Y\n").encode())
    read_until(terminal, {"READY"})
    os.write(terminal, " ".join(["grafu", *words]).encode() + b"\t\t")
    seen = read_until(terminal, wanted)
    os.kill(pid, 9)
    os.waitpid(pid, 0)
    os.close(terminal)
    return seen


def read_until(terminal: int, wanted: set[str], seconds: float = 30.0) -> set[str]:
    """Returns the words that a terminal shows, read until all wanted are among them or the seconds are over."""
    import select

    shown, end = "", monotonic() + seconds
    while not wanted <= (seen := words_of(shown)) and monotonic() < end:
        if select.select([terminal], [], [], 0.1)[0]:
            shown += os.read(terminal, 65536).decode(errors="replace")
    return seen


def words_of(shown: str) -> set[str]:
    plain = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]|[\a\b\r]", " ", shown)
    return {word.rstrip(",") for word in plain.split()}  # zsh begins the next name of a list


ASK = {"bash": bash, "zsh": zsh, "fish": fish}


@pytest.mark.parametrize("shell", SHELLS)
def test_the_shell_completes_verbs_options_choices_formats_and_files(shell: str, scripts: Path, tmp_path: Path) -> None:
    if shutil.which(shell) is None:
        pytest.skip(f"{shell} is not installed")
    (tmp_path / "wardrobe.glb").touch()
    offered = partial(ASK[shell], scripts / shell, tmp_path)

    for words, wanted in {
        ("funct",): {"functionalize"},
        ("functionalize", "--form"): {"--formats"},
        ("functionalize", "--formats", ""): set(FORMATS),
        ("functionalize", "--formats", "glb,ur"): {"glb,urdf"},  # the last of a list
        ("functionalize", "--motion", "ann"): {"annotation"},
        ("functionalize", "--handle", "knob-r"): {"knob-round"},
        ("functionalize", "--base", ""): {"wall", "free"},
        ("functionalize", "--catch", ""): {"none", "detent", "self-closing"},
        ("inspect", "ward"): {"wardrobe.glb"},
    }.items():
        assert wanted <= offered(list(words), wanted), words


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_a_verb_is_described_in_one_line(shell: str, scripts: Path) -> None:
    script = (scripts / shell).read_text()
    assert "make furniture work: hinges, rails, limits" in script
    assert "Reads part-segmented furniture" not in script


def test_another_shell_is_refused_with_those_that_there_are(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["completion", "tcsh"])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert all(shell in said for shell in SHELLS)
