"""`dataclass` of the standard library, whose methods are compiled when they are needed.

The standard library compiles six methods of each frozen dataclass when its module is imported, two fifths of the time
in which this package was imported. Here `__repr__`, `__eq__` and `__hash__` are compiled, by the standard library too,
at their first call, and then replace the function that waited for it; `__init__` after some calls: of most classes
there are few values, often their defaults alone. The records of fields, that `dataclasses.fields` returns, are made by
the standard library when they are first asked for: of most classes they never are.
"""

import dataclasses
import inspect
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any, Final, NoReturn

from grafu.late_fields import GivenFields, given_fields, with_late_fields

_BY_HAND: Final = 64
"""Values of a class that are filled by hand; the next costs as much as to compile its `__init__`."""
_WAITS: Final = "waits_to_be_compiled"
_ALONE: Final = {"init": False, "repr": False, "eq": False}
_INIT: Final = {"init": True, "frozen": True}
_COMPILED: Final = {"__repr__": {"repr": True}, "__eq__": {"eq": True}, "__hash__": {"unsafe_hash": True}}
"""Options with which the standard library compiles one method alone."""

if TYPE_CHECKING:
    from dataclasses import dataclass as dataclass
else:

    def dataclass(cls=None, /, *, frozen=False, eq=True, repr=True, order=False, slots=False, kw_only=False):  # noqa: A002
        """Makes a class a dataclass, or returns the decorator that does, as that of the standard library.

        Classes that are not frozen, or that are ordered, are compiled at once. A frozen value refuses every attribute,
        not only those of its fields. Fields of the kind `InitVar` are not supported.
        """
        options = {"frozen": frozen, "eq": eq, "repr": repr, "order": order, "slots": slots, "kw_only": kw_only}

        def made(cls):
            return _with_late_methods(cls, options) if frozen and not order else dataclasses.dataclass(**options)(cls)

        return made if cls is None else made(cls)


def _with_late_methods(cls: type, options: dict[str, bool]) -> type:
    own = dict(cls.__dict__)
    given = given_fields(cls, own, options["kw_only"])
    made = _by_library(cls, options) if given is None else with_late_fields(cls, own, given, options["slots"])
    if "__init__" not in own:
        made.__init__, made.__signature__ = _late_init(made, given), _SIGNATURE
    if options["repr"] and "__repr__" not in own:
        made.__repr__ = _late_method(made, "__repr__")
    if options["eq"] and "__eq__" not in own:
        made.__eq__ = _late_method(made, "__eq__")
    if options["eq"] and own.get("__hash__") is None:
        made.__hash__ = _late_method(made, "__hash__")
    made.__setattr__, made.__delattr__ = _refuse_set, _refuse_delete
    if options["slots"] and "__getstate__" not in own:
        made.__getstate__, made.__setstate__ = _state, _restore
    made.__dataclass_params__ = _params(**options)
    return made


def _by_library(cls: type, options: dict[str, bool]) -> Any:
    derived = any(dataclasses.is_dataclass(base) for base in cls.__mro__[1:])
    like = {name: options[name] for name in ("slots", "kw_only")}
    return dataclasses.dataclass(**_ALONE, frozen=derived, **like)(cls)


def _late_init(made: type, given: GivenFields | None) -> Callable[..., None]:
    """Returns an `__init__` that fills the first values by hand, and is compiled then."""
    compiled: list[Callable[..., None]] = []
    calls = 0
    fill = _fill if given is None or not given.is_plain else _fill_of(made, given)

    def late(self: object, *args: Any, **kwargs: Any) -> None:
        nonlocal calls
        calls += 1
        if calls <= _BY_HAND and fill(self, args, kwargs):
            return
        if not compiled:
            compiled.append(_compiled(made, "__init__", _INIT))
            _replace(made, "__init__", late, compiled[0])
        compiled[0](self, *args, **kwargs)

    return _named(late, made, "__init__")


def _fill_of(made: type, given: GivenFields) -> "Callable[[Any, tuple[Any, ...], dict[str, Any]], bool]":
    """Returns `_fill` for a class whose fields may each be given in their place."""
    names, defaults, factories = tuple(given.types), given.values, given.factories
    is_checked, set_field = hasattr(made, "__post_init__"), object.__setattr__

    def fill(self: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> bool:
        if kwargs or len(args) != len(names):
            values = {**dict(zip(names, args, strict=False)), **kwargs}
            if len(values) < len(args) + len(kwargs):
                return False
            values = {**defaults, **values}
            values.update((name, make()) for name, make in factories.items() if name not in values)
            if values.keys() != given.types.keys():
                return False
            args = tuple(values[name] for name in names)
        for name, value in zip(names, args, strict=True):
            set_field(self, name, value)
        if is_checked:
            self.__post_init__()
        return True

    return fill


def _fill(self: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> bool:
    """Gives a value its fields, and returns whether it could: all that were given are fields, and none lacks."""
    fields = dataclasses.fields(self)
    given = dict(zip((field.name for field in fields if not field.kw_only), args, strict=False))
    count = len(args) + len(kwargs)
    given |= kwargs
    if len(given) < count or not all(field.init for field in fields):
        return False
    values = []
    for field in fields:
        if field.name in given:
            values.append(given.pop(field.name))
        elif field.default is not dataclasses.MISSING:
            values.append(field.default)
        elif field.default_factory is not dataclasses.MISSING:
            values.append(field.default_factory())
        else:
            return False
    if given:
        return False
    for field, value in zip(fields, values, strict=True):
        object.__setattr__(self, field.name, value)
    if hasattr(self, "__post_init__"):
        self.__post_init__()
    return True


def _late_method(made: type, name: str) -> Callable[..., Any]:
    """Returns a method that is compiled at its first call, and replaced."""
    compiled: list[Callable[..., Any]] = []

    def late(self: object, *args: Any) -> Any:
        if not compiled:
            compiled.append(_compiled(made, name, _COMPILED[name]))
            _replace(made, name, late, compiled[0])
        return compiled[0](self, *args)

    return _named(late, made, name)


def _compiled(made: type, name: str, only: dict[str, bool]) -> Callable[..., Any]:
    """Returns a method as the standard library compiles it of a class that has the same fields."""
    fields = dataclasses.fields(made)
    body: dict[str, Any] = {"__module__": made.__module__, "__qualname__": made.__qualname__, "__doc__": made.__name__}
    body["__annotations__"] = {field.name: field.type for field in fields}
    body |= {field.name: field for field in fields}
    if hasattr(made, "__post_init__"):
        body["__post_init__"] = None
    twin: Any = dataclasses.dataclass(**{**_ALONE, **only})(type(made.__name__, (), body))
    return twin.__dict__[name]


def compiled_init(cls: type) -> Callable[..., None]:
    """Returns the `__init__` of a class, compiled if it waits for that."""
    init: Callable[..., None] = cls.__init__  # type: ignore[misc]
    return _compiled(cls, "__init__", _INIT) if hasattr(init, _WAITS) else init


class _Signature:
    """What `inspect.signature` returns of a class whose `__init__` is not compiled yet."""

    def __get__(self, value: object, owner: type) -> inspect.Signature:
        signature = inspect.signature(compiled_init(owner))
        return signature.replace(parameters=list(signature.parameters.values())[1:])


_SIGNATURE: Final = _Signature()


def _replace(made: type, name: str, late: Callable[..., Any], method: Callable[..., Any]) -> None:
    """Puts a compiled method into the place of the one that waited, unless another took it meanwhile."""
    if made.__dict__.get(name) is late:
        setattr(made, name, method)


def _named(late: Any, made: type, name: str) -> Callable[..., Any]:
    setattr(late, _WAITS, True)
    late.__name__, late.__qualname__, late.__module__ = name, f"{made.__qualname__}.{name}", made.__module__
    return late


def _refuse_set(_: object, name: str, __: object) -> NoReturn:
    raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")


def _refuse_delete(_: object, name: str) -> NoReturn:
    raise dataclasses.FrozenInstanceError(f"cannot delete field {name!r}")


def _state(self: Any) -> list[Any]:
    """Returns what pickle keeps of a value with slots."""
    return [getattr(self, field.name) for field in dataclasses.fields(self)]


def _restore(self: Any, state: list[Any]) -> None:
    for field, value in zip(dataclasses.fields(self), state, strict=True):
        object.__setattr__(self, field.name, value)


@cache
def _params(**options: bool) -> Any:
    """Returns the record of options that the standard library keeps of a class."""
    empty: Any = dataclasses.dataclass(**options)(type("Empty", (), {"__doc__": ""}))
    return empty.__dataclass_params__
