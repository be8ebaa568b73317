"""Draws docs/api.md from the docstrings of the Python functions."""

import inspect
import re
from collections.abc import Callable
from typing import Any

import grafu

HEAD = """\
# Python

<!-- drawn by scripts/docs.py from src/grafu/api -->

```python
import grafu

result = grafu.functionalize("samples/sideboard.glb")
for joint in result.joints:
    print(joint.part, joint.type, joint.upper)
result.with_hinge("door_1", side="right").save("results/sideboard", formats=["glb", "urdf"])
```

Paths are `str` or `Path`. An argument of a wrong type raises a `TypeError`; everything else that a user can mend is a
`grafu.FunctionalizationError` with one line ([errors](errors.md)). Values are frozen: a change gives a new result, and
recomputes only what it affects. More in [examples](../examples/README.md).
"""
METHODS = ("joint", "with_motion", "with_hinge", "with_rail", "with_handle", "with_label", "without", "save")


def api_page() -> str:
    """Returns docs/api.md."""
    functions = [
        _function(f"grafu.{each.__name__}", each) for each in (grafu.load, grafu.functionalize, grafu.piece_names)
    ]
    fields = "\n".join(f"| `{name}` | {_first(each)} |" for name, each in _properties())
    methods = [_function(f"Result.{name}", getattr(grafu.Result, name)) for name in METHODS]
    head = f"## grafu.Result\n\n{_text(inspect.getdoc(grafu.Result) or '')}\n\n| attribute | what it is |\n|---|---|\n"
    return "\n".join([HEAD, *functions, head + fields + "\n", *methods])


def _properties() -> list[tuple[str, Any]]:
    return [
        (name, each)
        for name, each in vars(grafu.Result).items()
        if not name.startswith("_")
        and not callable(each)
        and hasattr(each, "__doc__")
        and not isinstance(each, classmethod)
        and inspect.getdoc(each)
    ]


def _first(value: Any) -> str:
    return " ".join((inspect.getdoc(value) or "").split())


def _function(name: str, function: Callable[..., Any]) -> str:
    doc = inspect.getdoc(function) or ""
    about, _, rest = doc.partition("\n\nArgs:\n")
    arguments, _, errors = rest.partition("\n\nRaises:\n") if rest else ("", "", "")
    if not rest:
        about, _, errors = doc.partition("\n\nRaises:\n")
    table = "| argument | what it is |\n|---|---|\n" + _rows(arguments) if arguments else ""
    raised = f"Raises {_raised(errors)}" if errors else ""
    sections = [f"## {name}", f"```text\n{name}{_signature(function)}\n```", _text(about), table, raised]
    return "\n\n".join(section for section in sections if section) + "\n"


def _signature(function: Callable[..., Any]) -> str:
    found = inspect.signature(function)
    kept = [p.replace(annotation=inspect.Parameter.empty) for p in found.parameters.values() if p.name != "self"]
    lines = [str(p) if p.default is p.empty else f"{p.name}={p.default!r}" for p in kept if p.name != "self"]
    first_keyword = next((k for k, p in enumerate(kept) if p.kind is p.KEYWORD_ONLY), None)
    if first_keyword is not None:
        lines.insert(first_keyword, "*")
    text = f"({', '.join(lines)})"
    return text if len(text) < 100 else "(\n    " + ",\n    ".join(lines) + ",\n)"


def _items(text: str) -> list[tuple[str, str]]:
    """Returns name and description of each entry of a section of a docstring."""
    joined = re.sub(r"\n {8,}", " ", text)
    pairs = (line.strip().partition(":") for line in joined.splitlines() if line.strip())
    return [(name, description.strip()) for name, _, description in pairs]


def _rows(text: str) -> str:
    return "\n".join(f"| `{name.lstrip('*')}` | {description} |" for name, description in _items(text))


def _raised(text: str) -> str:
    return "; ".join(f"`{name}` {description.rstrip('.')}" for name, description in _items(text)) + "."


def _text(text: str) -> str:
    paragraphs = [" ".join(each.split()) for each in text.split("\n\n")]
    return "\n\n".join(paragraphs)
