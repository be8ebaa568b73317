"""What all records of a report have in common: they are written as JSON, and read from it again.

Records are frozen dataclasses, whose fields are given by name. `pydantic`, which reads them, is imported when one is
read: a run that writes a report spares a tenth of a second.
"""

from collections.abc import Callable
from dataclasses import MISSING, field, fields, replace
from enum import Enum
from types import UnionType
from typing import Annotated, Any, ClassVar, TypeVar, dataclass_transform, get_args, get_type_hints

from grafu.dataclass import dataclass
from grafu.visible import short_repr

Record = TypeVar("Record", bound="ReportRecord")
_READERS: dict[Any, Any] = {}


def stated(*, description: str, default: Any = MISSING, default_factory: Any = MISSING) -> Any:
    """Returns a field of a record; `description` states in docs/report.md what it means."""
    if default_factory is not MISSING:
        return field(default_factory=default_factory, metadata={"description": description})
    return field(default=default, metadata={"description": description})


class NumberFrom:
    """In an annotation: a number that is read must be finite, and lie between two ends (None: it has none)."""

    def __init__(self, least: int | None = None, most: int | None = None) -> None:
        self.ends = {name: end for name, end in (("ge", least), ("le", most)) if end is not None}

    def __get_pydantic_core_schema__(self, source: Any, handler: Callable[[Any], dict[str, Any]]) -> dict[str, Any]:
        """Returns what pydantic reads such a number by."""
        finite = {"allow_inf_nan": False} if source is float else {}
        return {**handler(source), **finite, **self.ends}


FiniteFloat = Annotated[float, NumberFrom()]
Ratio = Annotated[float, NumberFrom(0, 1)]
Count = Annotated[int, NumberFrom(0)]


@dataclass_transform(kw_only_default=True, frozen_default=True, field_specifiers=(stated,))
class ReportRecord:
    """Abstract base: every class below it is made a frozen dataclass; to read one is strict about unknown fields."""

    __pydantic_config__ = {"extra": "forbid"}  # noqa: RUF012  # no field: without an annotation

    _floats: ClassVar[tuple[str, ...]] = ()

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        dataclass(frozen=True, repr=False, kw_only=True)(cls)
        cls._floats = _floats_of(cls)

    def __post_init__(self) -> None:
        for name in self._floats:
            value = getattr(self, name)
            if value is not None and type(value) is not float:  # whole numbers are written with their point, too
                object.__setattr__(self, name, float(value))

    def __repr__(self) -> str:
        return short_repr(type(self).__name__, ((one.name, getattr(self, one.name)) for one in fields(self)))  # type: ignore[arg-type]

    __str__ = __repr__

    def with_changes(self: Record, **changes: Any) -> Record:
        """Returns the record with other values of some fields."""
        return replace(self, **changes)  # type: ignore[type-var]

    def to_json(self) -> dict[str, Any]:
        """Returns the JSON-ready dict."""
        return {name: _plain(getattr(self, name)) for name in self.__dataclass_fields__}  # type: ignore[attr-defined]

    @classmethod
    def read(cls: type[Record], values: object) -> Record:
        """Returns the record that plain values of JSON state.

        Raises:
            pydantic.ValidationError: if a value is missing, unknown or wrong.
        """
        record: Record = cls._reader().validate_python(values)
        return record

    @classmethod
    def read_json(cls: type[Record], text: str | bytes) -> Record:
        """Returns the record that a JSON file holds; raises as `read` does."""
        record: Record = cls._reader().validate_json(text)
        return record

    @classmethod
    def _reader(cls) -> Any:
        """Returns pydantic's reader of the record; beartype cannot check its type."""
        if cls not in _READERS:
            from pydantic import TypeAdapter

            _READERS[cls] = TypeAdapter(cls)
        return _READERS[cls]


def described(record: type[ReportRecord]) -> dict[str, tuple[Any, str]]:
    """Returns by field of a record its type, without conditions, and what it means."""
    types = get_type_hints(record)
    return {one.name: (types[one.name], one.metadata["description"]) for one in fields(record)}  # type: ignore[arg-type]


def _floats_of(record: type[ReportRecord]) -> tuple[str, ...]:
    """Returns the fields of a record that hold a float, or a float and else nothing."""
    types = {one.name: one.type for one in fields(record)}  # type: ignore[arg-type]
    return tuple(name for name, held in types.items() if any(map(_is_float, (held, *_either(held)))))


def _either(held: Any) -> tuple[Any, ...]:
    """Returns the types of which a value may have any."""
    return get_args(held) if isinstance(held, UnionType) else ()


def _is_float(held: Any) -> bool:
    return held is float or getattr(held, "__origin__", None) is float


def _plain(value: Any) -> Any:
    if isinstance(value, ReportRecord):
        return value.to_json()
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    return [_plain(item) for item in value] if isinstance(value, tuple | list) else value
