"""The fuzzer finds what breaks a rule, makes the same case again, and reads all its starting files as they are."""

import os
import subprocess
import sys
from hashlib import sha256
from random import Random

import pytest

from fuzz.cases import FAMILIES, NAMES, make_case, start_of
from fuzz.planted import LARGE, PLANTED, WAITING, WITHOUT_END
from fuzz.runner import Plan, repeat_line, run_cases, summary
from fuzz.starting_models import MODELS
from fuzz.worker import Limits

NATIVE = "by native code"  # heard of on Linux alone
LIMITS = {
    **dict.fromkeys(WITHOUT_END, Limits(processor=1.0)),
    **dict.fromkeys(WAITING, Limits(clock=1.0)),
    **dict.fromkeys(LARGE, Limits(memory=450 * 2**20)),
}


@pytest.mark.parametrize("limits", [Limits(), *set(LIMITS.values())], ids=str)
def test_every_rule_that_is_broken_is_told_and_nothing_else(limits):
    planted = [index for index, (name, *_) in enumerate(PLANTED) if LIMITS.get(name, Limits()) == limits]
    answers = run_cases(Plan(0, tuple(planted), jobs=2, limits=limits, cases="fuzz.planted"))
    for answer, (name, *_) in zip(answers, (PLANTED[index] for index in planted), strict=True):
        if name.startswith("innocent: "):
            assert (answer.outcome, answer.broken) == (name.removeprefix("innocent: ").split()[0], ()), name
        elif name != NATIVE or sys.platform.startswith("linux"):
            assert answer.outcome == "broken", name
            assert any(name in why for why in answer.broken), (name, answer.broken)


def test_a_fault_of_the_fuzzer_itself_ends_the_run():
    with pytest.raises(IndexError):
        run_cases(Plan(0, (0, len(PLANTED)), cases="fuzz.planted"))


def test_a_case_that_broke_a_rule_is_told_with_the_command_that_runs_it_again():
    plan = Plan(7, (0,), cases="fuzz.planted")
    [answer] = run_cases(plan)
    assert repeat_line(plan, answer).startswith("make fuzz SEED=7 CASE=0   # raises ValueError")
    assert "\n" not in repeat_line(plan, answer)
    assert summary([answer]).splitlines()[2].split() == ["all", "1", "1"]


def test_a_case_follows_from_its_seed_and_index():
    code = "from fuzz.cases import NAMES, make_case; print([hash_of(make_case(3, k)) for k, _ in enumerate(NAMES)])"
    code = f"from hashlib import sha256\nhash_of = lambda case: sha256(repr(case).encode()).hexdigest()\n{code}"
    other = "2" if os.environ.get("PYTHONHASHSEED") == "1" else "1"  # than that of this process
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "PYTHONHASHSEED": other}
    command = [sys.executable, "-c", code]
    said = subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout

    assert said.strip() == str([sha256(repr(make_case(3, k)).encode()).hexdigest() for k, _ in enumerate(NAMES)])
    assert make_case(4, 1) != make_case(3, 1)


@pytest.mark.parametrize("family", FAMILIES)
def test_every_change_finds_something_to_change(family):
    starts = [start_of(name)[0] for name in NAMES]
    for change in FAMILIES[family][1]:
        tried = ((files, change(files, Random(k))) for k in range(20) for files in starts)
        assert any(changed is not None and changed != files for files, changed in tried), change.__name__


@pytest.mark.parametrize("cases", ["library", "command"])
def test_what_is_not_changed_is_read(cases):
    few = ("obj", "partnet-mobility")  # of the models: the other tests of the command try all
    wanted = [k for k, name in enumerate(NAMES) if cases == "library" or name in few or name not in MODELS]
    for answer in run_cases(Plan(0, tuple(wanted), cases=f"fuzz.unchanged_by_{cases}")):
        assert answer.outcome in ("read", "done"), answer


@pytest.mark.slow
def test_no_case_breaks_a_rule():
    """The first of them: `make fuzz` runs as many as one likes."""
    plan = Plan(15, tuple(range(44)))  # each kind of starting files at least once
    answers = run_cases(plan)
    assert len(answers) == 44 >= len(NAMES)
    assert [repeat_line(plan, answer) for answer in answers if answer.broken] == []
    assert {answer.outcome for answer in answers} == {"read", "done", "refused"}
