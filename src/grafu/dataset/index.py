"""The index of a set: a row for each model as a line of JSON, and as Parquet where pyarrow is installed."""

from contextlib import ExitStack
from pathlib import Path
from typing import Any, Final, final

from grafu.dataset.figures import COLUMNS, MOTION_FIELDS, ColumnKind, Row
from grafu.dataset.layout import INDEX, PARQUET, json_line

_ROWS_AT_ONCE: Final = 1000


def writes_parquet() -> bool:
    """Whether pyarrow is installed (`grafu[dataset]`)."""
    try:
        import pyarrow  # noqa: F401
    except ImportError:
        return False
    return True


@final
class IndexWriter:
    """Writes the rows as they come; a thousand are held at most."""

    def __init__(self, folder: Path) -> None:
        self._closing = ExitStack()
        self._lines = self._closing.enter_context((folder / INDEX).open("wb"))
        self._table = self._closing.enter_context(_ParquetTable(folder / PARQUET)) if writes_parquet() else None

    def __enter__(self) -> "IndexWriter":
        return self

    def __exit__(self, *_: object) -> None:
        self._closing.close()

    def add(self, row: Row) -> None:
        """Writes a row."""
        self._lines.write(json_line(row))
        if self._table is not None:
            self._table.add(row)


@final
class _ParquetTable:
    def __init__(self, path: Path) -> None:
        from pyarrow.parquet import ParquetWriter

        self._schema = _schema()
        self._writer = ParquetWriter(path, self._schema)
        self._held: list[Row] = []

    def __enter__(self) -> "_ParquetTable":
        return self

    def __exit__(self, *_: object) -> None:
        self._flush()
        self._writer.close()

    def add(self, row: Row) -> None:
        self._held.append(row)
        if len(self._held) >= _ROWS_AT_ONCE:
            self._flush()

    def _flush(self) -> None:
        from pyarrow import Table

        if self._held:
            self._writer.write_table(Table.from_pylist(self._held, schema=self._schema))
            self._held = []


def _schema() -> Any:
    import pyarrow

    plain = {"text": pyarrow.string(), "whole number": pyarrow.int64(), "number": pyarrow.float64()}

    def typed(kind: ColumnKind) -> Any:
        if kind == "motions":
            return pyarrow.list_(pyarrow.struct([(name, plain[held]) for name, held in MOTION_FIELDS.items()]))
        return plain[kind] if kind in plain else pyarrow.list_(plain[kind.removesuffix("s")])

    return pyarrow.schema([(column.name, typed(column.kind)) for column in COLUMNS])
