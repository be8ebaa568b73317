"""A measured table in Markdown, as all benchmarks print theirs. It measures nothing."""

from collections.abc import Iterable


def measured_table(title: str, states: str, rows: Iterable[tuple[str, str]]) -> str:
    """Returns a heading, a sentence on what was measured, and the names and values."""
    body = "\n".join(f"| {name} | {value} |" for name, value in rows)
    return f"## {title}\n\n{states}\n\n| what | measured |\n|---|---|\n{body}\n"
