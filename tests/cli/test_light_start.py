"""The command starts without jaxtyping, and with values that behave as those of the standard library."""

import dataclasses
import os
import pickle
import subprocess
import sys
from dataclasses import FrozenInstanceError, dataclass, field
from pathlib import Path
from typing import Any

import pytest

from grafu.cli.light_start import with_shared_methods

SAMPLE = Path(__file__).parents[2] / "samples" / "dresser.glb"
NOT_NEEDED = {"jaxtyping", "jaxtyping._import_hook", "unittest.mock", "asyncio", "ssl"}
SHARED = ("_cmp_fn", "_hash_fn", "_repr_fn", "_frozen_get_del_attr")


def classes(module: str) -> dict[str, Any]:
    """Returns classes of many kinds, made anew: the same each time."""

    class Namespace:
        @dataclass(frozen=True)
        class Pair:
            a: int
            b: Any = ()

        @dataclass(frozen=True, slots=True)
        class One:
            a: float = float("nan")

        @dataclass(frozen=True)
        class Empty:
            pass

        @dataclass(frozen=True, order=True)
        class Ordered:
            a: int
            hidden: int = field(default=0, compare=False, repr=False)

        @dataclass
        class Open:
            a: list[Any]

        @dataclass(frozen=True, eq=False)
        class Own:
            a: int

            def __hash__(self) -> int:
                return 7

    class Longer(Namespace.Pair):
        """No dataclass: it may have more attributes, but must not change those of its base."""

    made = {**{k: v for k, v in vars(Namespace).items() if isinstance(v, type)}, "Longer": Longer}
    for name, kind in made.items():
        kind.__qualname__, kind.__module__ = name, module
    return made


def refusal(do: Any, *arguments: Any) -> tuple[type, str] | None:
    try:
        do(*arguments)
    except (FrozenInstanceError, AttributeError, TypeError) as error:
        return type(error), str(error)
    return None


def behaviour(made: dict[str, Any]) -> list[Any]:
    """Returns what can be seen of instances: their texts, what is equal, what is refused, and how."""
    pair, longer, one = made["Pair"](1, (2,)), made["Longer"](1, (2,)), made["One"]
    inside: list[Any] = []
    inside.append(made["Open"](inside))  # it holds itself
    own, less, more = made["Own"](1), made["Ordered"](1, 5), made["Ordered"](2, 4)
    values = [pair, longer, made["Pair"](1, (2,)), made["Pair"](2), one(), one(1.0), made["Empty"](), own, less, more]
    longer.other = 3
    return [
        [repr(value) for value in (*values, inside)],
        [[a == b for b in values] for a in values],
        [hash(value) for value in values if value is not values[4]],  # of NaN each has another
        [pair.__eq__(3), made["Ordered"](1, 5) == made["Ordered"](1, 6), less < more, refusal(hash, inside[0])],
        [refusal(setattr, value, name, 1) for value in values for name in ("a", "new")],
        [refusal(delattr, value, name) for value in values for name in ("a", "new", "other")],
        [getattr(kind, name).__qualname__ for kind in made.values() for name in ("__repr__", "__eq__", "__setattr__")],
        dataclasses.replace(pair, a=5).a,
    ]


def test_values_behave_as_those_of_the_standard_library(monkeypatch):
    kept = {name: getattr(dataclasses, name) for name in SHARED if hasattr(dataclasses, name)}
    usual = behaviour(classes(__name__))
    for name, function in kept.items():
        monkeypatch.setattr(dataclasses, name, function)  # as they are, so that they come back
    with_shared_methods()
    light = classes(__name__)

    assert behaviour(light) == usual
    monkeypatch.setattr(sys.modules[__name__], "Pair", light["Pair"], raising=False)
    assert pickle.loads(pickle.dumps(light["Pair"](1, 2))) == light["Pair"](1, 2)
    if sys.version_info < (3, 13):
        assert all(getattr(dataclasses, name) is not function for name, function in kept.items())


def test_functions_that_are_not_as_known_are_left_alone(monkeypatch):
    def other(cls: type, fields: Any, func_builder: Any) -> None:
        """What the next version of the standard library may have."""

    for name in SHARED:
        monkeypatch.setattr(dataclasses, name, other, raising=False)
    with_shared_methods()
    assert all(getattr(dataclasses, name) is other for name in SHARED)


def test_the_command_imports_no_checks_of_shapes(tmp_path: Path) -> None:
    arguments = ["functionalize", str(SAMPLE), "--formats", "glb", "--no-page", "--out", str(tmp_path)]
    run = subprocess.run(
        [sys.executable, "-X", "importtime", "-m", "grafu", *arguments],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )
    imported = {line.rpartition("|")[2].strip() for line in run.stderr.splitlines() if line.startswith("import time:")}

    assert {"grafu.pipeline.functionalize", "grafu.geometry.arrays"} <= imported
    assert imported & NOT_NEEDED == set()


def test_a_program_that_calls_the_command_keeps_the_standard_library(monkeypatch, capsys):
    from grafu.cli.main import main

    kept = {name: getattr(dataclasses, name) for name in SHARED if hasattr(dataclasses, name)}
    with pytest.raises(SystemExit):
        main(["--version"])
    assert {name: getattr(dataclasses, name) for name in kept} == kept
