"""What the command does without as it starts: array shapes that nobody checks, and a method compiled for each class.

Both are for the command's own processes alone: a program that imports grafu as a library keeps all as it is.
Array shapes are checked by the tests; in a run the names of jaxtyping stand for the plain array class, and jaxtyping,
with a third of all modules of the standard library behind it, is not imported. `dataclass` writes and compiles the
source of six methods for each of our 400 classes; of five of them one function does the same for all.
"""

import dataclasses
import sys
from collections.abc import Callable, Sequence
from dataclasses import FrozenInstanceError
from operator import attrgetter
from reprlib import recursive_repr
from types import ModuleType
from typing import Any

Fields = Sequence["dataclasses.Field[Any]"]
_SHAPES = (
    *("Bool", "Int", "UInt", "Float", "Complex", "Num", "Real", "Inexact", "Integer", "Shaped"),
    *(f"{kind}{bits}" for kind in ("Int", "UInt") for bits in (8, 16, 32, 64)),
    *(f"Float{bits}" for bits in (16, 32, 64)),
)


class _AnyShape:
    """What stands for a jaxtyping name: with a class and a shape in brackets it is that class."""

    def __getitem__(self, stated: tuple[Any, str]) -> Any:
        return stated[0]


def without_shape_checks() -> None:
    """Lets this process's modules be imported without jaxtyping; does nothing where it is imported already."""
    if "jaxtyping" not in sys.modules:
        light = ModuleType("jaxtyping", "The names of array shapes, which nothing checks in this process.")
        light.__dict__.update(dict.fromkeys(_SHAPES, _AnyShape()))
        sys.modules["jaxtyping"] = light


def with_shared_methods() -> None:
    """Lets `dataclass` take shared functions for what it would compile for each class; all behaves the same.

    It replaces functions of the standard library that make these methods, where they are as they were up to Python
    3.12 (later ones compile once for each class); where not, it changes nothing.
    """
    for name, (parameters, shared) in _SHARED.items():
        written = getattr(dataclasses, name, None)
        code = getattr(written, "__code__", None)
        if code is not None and code.co_varnames[: code.co_argcount] == parameters:
            setattr(dataclasses, name, shared)


def _values(names: Sequence[str]) -> Callable[[object], tuple[Any, ...]]:
    """Returns what reads these attributes of an instance, as a tuple."""
    if len(names) > 1:
        return attrgetter(*names)
    return (lambda value: (getattr(value, names[0]),)) if names else lambda _: ()


def _comparison(name: str, op: str, self_tuple: str, other_tuple: str, globals: Any) -> Callable[..., Any]:  # noqa: A002
    if op != "==":
        return _COMPILED(name, op, self_tuple, other_tuple, globals)
    of = _values([each.removeprefix("self.") for each in self_tuple.strip("()").split(",") if each])

    def is_equal(self: Any, other: Any) -> Any:
        return of(self) == of(other) if other.__class__ is self.__class__ else NotImplemented

    return _named("__eq__", is_equal)


def _hash(fields: Fields, _: Any) -> Callable[..., Any]:
    of = _values([field.name for field in fields])
    return _named("__hash__", lambda self: hash(of(self)))


def _repr(fields: Fields, _: Any) -> Callable[..., Any]:
    names = [field.name for field in fields]

    @recursive_repr()
    def stated(self: Any) -> str:
        values = ", ".join(f"{name}={getattr(self, name)!r}" for name in names)
        return f"{self.__class__.__qualname__}({values})"

    return _named("__repr__", stated)


def _refusals(cls: Any, fields: Fields, _: Any) -> tuple[Callable[..., None], Callable[..., None]]:
    names = frozenset(field.name for field in fields)

    def set_attribute(self: Any, name: str, value: Any) -> None:
        if type(self) is cls or name in names:
            raise FrozenInstanceError(f"cannot assign to field {name!r}")
        super(cls, self).__setattr__(name, value)

    def delete_attribute(self: Any, name: str) -> None:
        if type(self) is cls or name in names:
            raise FrozenInstanceError(f"cannot delete field {name!r}")
        super(cls, self).__delattr__(name)

    return _named("__setattr__", set_attribute), _named("__delattr__", delete_attribute)


def _named(name: str, method: Callable[..., Any]) -> Callable[..., Any]:
    method.__name__ = name
    return method


_COMPILED: Callable[..., Any] = getattr(dataclasses, "_cmp_fn", lambda *_: None)
_SHARED: dict[str, tuple[tuple[str, ...], Callable[..., Any]]] = {
    "_cmp_fn": (("name", "op", "self_tuple", "other_tuple", "globals"), _comparison),
    "_hash_fn": (("fields", "globals"), _hash),
    "_repr_fn": (("fields", "globals"), _repr),
    "_frozen_get_del_attr": (("cls", "fields", "globals"), _refusals),
}
