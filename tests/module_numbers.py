"""Numbers that stand in source code: as values of a module, and inside its functions."""

import ast
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path

NEUTRAL = frozenset({0.0, 0.5, 1.0, 2.0})
"""Halves and doubles: the middle between two ends, the majority of some cells."""
TINY = 1e-6
"""Numbers up to this keep a division or a comparison sound."""


def numbers_in(source: str) -> Iterator[str]:
    """Yields the names that a module gives to values with a number in them; calls of its own classes are none."""
    for node in ast.parse(source).body:
        if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None:
            continue
        if any(isinstance(n, ast.Constant) and type(n.value) in (int, float) for n in ast.walk(node.value)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            yield from (ast.unparse(target) for target in targets)


def floats_in_functions(source: str) -> Iterator[float]:
    """Yields the numbers with a point in functions and methods, without `NEUTRAL` ones and tiny ones."""
    functions = (node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.FunctionDef))
    for function in functions:
        for node in ast.walk(function):
            value = node.value if isinstance(node, ast.Constant) and type(node.value) is float else 0.0
            if value not in NEUTRAL and value > TINY:
                yield value


def factors_in_functions(source: str) -> Iterator[int]:
    """Yields the whole numbers above 2 in functions that multiply, that are compared, or that are angles in degrees.

    Others above 4 as well: up to there they count the axes of space and the rows of a matrix.
    """
    functions = (node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.FunctionDef))
    for function in functions:
        for node in ast.walk(function):
            for part in ast.iter_child_nodes(node):
                if isinstance(part, ast.Constant) and type(part.value) is int:
                    least = 2 if _is_measure(node) else 4
                    if part.value > least:
                        yield part.value


def _is_measure(node: ast.AST) -> bool:
    """Whether a node multiplies, divides, compares or converts degrees."""
    if isinstance(node, ast.BinOp):
        return isinstance(node.op, ast.Mult | ast.Div)
    if isinstance(node, ast.Call):
        return ast.unparse(node.func).split(".")[-1] == "radians"
    return isinstance(node, ast.Compare)


def modules_of(folder: Path, but: Collection[str] = ()) -> Mapping[str, str]:
    """Returns the sources of a folder by their paths in it, `/` between folders."""
    paths = {path.relative_to(folder).as_posix(): path for path in sorted(folder.rglob("*.py"))}
    return {name: path.read_text(encoding="utf-8") for name, path in paths.items() if name not in but}


def named_numbers(folder: Path) -> dict[str, set[str]]:
    """Returns the names of numbers in the modules of a folder, for modules that have some."""
    found = {name: set(numbers_in(source)) for name, source in modules_of(folder).items()}
    return {name: names for name, names in found.items() if names}


def explanations(module: str, kind: str) -> dict[str, str]:
    """Returns the line under each field of a class in a source that explains it, for fields that have one."""
    found = next(node for node in ast.parse(module).body if isinstance(node, ast.ClassDef) and node.name == kind)
    return {
        a.target.id: str(b.value.value)
        for a, b in zip(found.body, found.body[1:], strict=False)
        if isinstance(a, ast.AnnAssign)
        and isinstance(a.target, ast.Name)
        and isinstance(b, ast.Expr)
        and isinstance(b.value, ast.Constant)
    }
