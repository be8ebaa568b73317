"""The fields of a class as they stand in it, and their records, made when they are first asked for.

The records are those of the standard library, which makes them: `dataclasses.fields` returns them. Most classes are
never asked for them, and to make them as its module is imported took a tenth of the time of that.
"""

import dataclasses
import inspect
from collections.abc import Callable, Mapping
from types import MemberDescriptorType
from typing import Any, ClassVar, Final, NamedTuple

FIELDS: Final = "__dataclass_fields__"
"""Where the standard library looks for the records of a class's fields."""


class GivenFields(NamedTuple):
    """What a class states about its fields: names in order, plain defaults, and records (`dataclasses.field`)."""

    types: Mapping[str, Any]
    defaults: dict[str, Any]
    records: "dict[str, dataclasses.Field[Any]]"
    kw_only: bool

    @property
    def positional(self) -> tuple[str, ...]:
        """The names of the fields that need not be given by name, as of a pattern that is matched."""
        if not self.records:
            return () if self.kw_only else tuple(self.types)
        return tuple(name for name in self.types if self._is_positional(self.records.get(name)))

    @property
    def is_plain(self) -> bool:
        """Whether each field may be given in its place."""
        return len(self.positional) == len(self.types)

    @property
    def values(self) -> dict[str, Any]:
        """The defaults, of records too."""
        stated = {n: r.default for n, r in self.records.items() if r.default is not dataclasses.MISSING}
        return self.defaults | stated

    @property
    def factories(self) -> dict[str, Callable[[], Any]]:
        """What makes a default for each value anew."""
        made = {n: r.default_factory for n, r in self.records.items()}
        return {n: make for n, make in made.items() if make is not dataclasses.MISSING}

    def _is_positional(self, record: "dataclasses.Field[Any] | None") -> bool:
        if record is None:
            return not self.kw_only
        return record.init and not (self.kw_only if record.kw_only is dataclasses.MISSING else record.kw_only)


def given_fields(cls: type, own: Mapping[str, Any], kw_only: bool) -> GivenFields | None:
    """Returns what a class states about its fields; None where it takes the standard library to tell.

    That is where it is derived from another dataclass, has a metaclass, no words, or anything but fields with a type.
    """
    types = inspect.get_annotations(cls)
    if type(cls) is not type or not own.get("__doc__") or any(FIELDS in vars(base) for base in cls.__mro__[1:]):
        return None
    defaults: dict[str, Any] = {}
    records: dict[str, dataclasses.Field[Any]] = {}
    for name, stated in types.items():
        if stated is dataclasses.KW_ONLY or _is_of_class(stated):
            return None
        value = getattr(cls, name, dataclasses.MISSING)
        if value is dataclasses.MISSING:
            continue
        if name not in own or type(value).__hash__ is None or isinstance(value, MemberDescriptorType):
            return None
        if isinstance(value, dataclasses.Field):
            records[name] = value
        else:
            defaults[name] = value
    if any(isinstance(value, dataclasses.Field) and name not in types for name, value in own.items()):
        return None
    return GivenFields(types, defaults, records, kw_only)


def _is_of_class(stated: object) -> bool:
    """Whether a type may state that what has it belongs to the class, and is no field."""
    if isinstance(stated, str):
        return "ClassVar" in stated or "KW_ONLY" in stated
    return stated is ClassVar or getattr(stated, "__origin__", None) is ClassVar


def with_late_fields(cls: Any, own: dict[str, Any], given: GivenFields, slots: bool) -> Any:
    """Returns a class whose fields are made when they are asked for; with `slots` another, that has them."""
    if slots:
        if "__slots__" in own:
            raise TypeError(f"{cls.__name__} already specifies __slots__")
        taken = {slot for base in cls.__mro__[1:-1] for slot in _slots_of(base)}
        rest = {name: value for name, value in own.items() if name not in given.types}
        rest.pop("__dict__", None)
        rest.pop("__weakref__", None)
        rest["__slots__"] = tuple(name for name in given.types if name not in taken)
        made = type(cls)(cls.__name__, cls.__bases__, rest)
        made.__qualname__ = cls.__qualname__
    else:
        made = cls
        for name, record in given.records.items():
            if record.default is dataclasses.MISSING:
                delattr(made, name)
            else:
                setattr(made, name, record.default)
    setattr(made, FIELDS, _LateFields(made, given))
    if "__match_args__" not in own:
        made.__match_args__ = given.positional  # type: ignore[misc]
    return made


def _slots_of(base: type) -> tuple[str, ...]:
    slots = vars(base).get("__slots__", ())
    return (slots,) if isinstance(slots, str) else tuple(slots)


class _LateFields:
    """The records of a class's fields, which the standard library makes when they are first asked for."""

    def __init__(self, home: type, given: GivenFields) -> None:
        self._home, self._given = home, given

    def __get__(self, _: object, __: type) -> "dict[str, dataclasses.Field[Any]]":
        given = self._given
        body = {
            "__module__": self._home.__module__,
            "__doc__": self._home.__doc__,
            "__annotations__": dict(given.types),
        }
        twin: Any = type(self._home.__name__, (), {**body, **given.defaults, **given.records})
        fields: dict[str, dataclasses.Field[Any]] = vars(
            dataclasses.dataclass(init=False, repr=False, eq=False, kw_only=given.kw_only)(twin)
        )[FIELDS]
        setattr(self._home, FIELDS, fields)
        return fields
