"""Changes of meshes written as text: OBJ, MTL, PLY, STL, OFF. Words and lines become other words and lines."""

from collections.abc import Callable
from random import Random

from fuzz.entries import Files, data_of, plain

TEXTS = (".obj", ".mtl", ".ply", ".stl", ".off")
_WORDS = (
    *("nan", "inf", "-inf", "1e400", "1e300", "-1e300", "0", "-1", "-99999999", "99999999999999999999", "1e-310", ""),
    *("1/1/1", "1//", "//", "1/0/0", "a", "0x1", "1,5", "\0", "1_000", "\u0661", "9" * 5000, "#", "\\"),
)
_LINES = (
    *("f 1 2 3", "f -1 -2 -3", "f 0 0 0", "f 1", "f", "v", "v 1", "v 1 2 3 4 5 6 7 8", "vt", "vn 0 0 0", "g", "o", "s"),
    *("usemtl", "usemtl x", "mtllib", "l 1 2", "p 1", "curv 0 1 1 2", "call x.obj", "csh ls", "vp 1", "end", "# x"),
    *("newmtl", "newmtl a", "map_Kd", "map_Kd -s 1 1 1", "Kd nan nan nan", "Kd spectral x", "d 1e400", "Ns -5", "Tr x"),
    *("element face 99999999", "element vertex -1", "property list uchar int x", "end_header", "facet", "OFF", "solid"),
)


def _of_lines(change: Callable[[list[str], Random], list[str]]) -> Callable[[Files, Random], Files | None]:
    def changed(files: Files, rng: Random) -> Files | None:
        names = [n for n in plain(files, *TEXTS) if b"\0" not in data_of(files, n) and files[n]]
        if not names:
            return None
        name = rng.choice(names)
        lines = data_of(files, name).decode("utf-8", "replace").split("\n")
        return {**files, name: "\n".join(change(lines, rng)).encode("utf-8", "surrogatepass")}

    changed.__name__ = change.__name__
    return changed


@_of_lines
def other_word(lines: list[str], rng: Random) -> list[str]:
    for _ in range(rng.choice((1, 1, 3))):
        at = rng.randrange(len(lines))
        words = lines[at].split(" ")
        words[rng.randrange(len(words))] = rng.choice(_WORDS)
        lines[at] = " ".join(words)
    return lines


@_of_lines
def other_line(lines: list[str], rng: Random) -> list[str]:
    lines[rng.randrange(len(lines))] = rng.choice(_LINES)
    return lines


@_of_lines
def more_words(lines: list[str], rng: Random) -> list[str]:
    at = rng.randrange(len(lines))
    lines[at] += (" " + rng.choice((lines[at].split(" ") or [""]) + ["1", "x"])) * rng.choice((1, 2, 1000))
    return lines


@_of_lines
def fewer_words(lines: list[str], rng: Random) -> list[str]:
    at = rng.randrange(len(lines))
    words = lines[at].split(" ")
    lines[at] = " ".join(words[: rng.randrange(len(words))])
    return lines


@_of_lines
def fewer_lines(lines: list[str], rng: Random) -> list[str]:
    start = rng.randrange(len(lines))
    return lines[:start] + lines[start + rng.randint(1, 20) :]


@_of_lines
def more_lines(lines: list[str], rng: Random) -> list[str]:
    start = rng.randrange(len(lines))
    piece = lines[start : start + rng.randint(1, 20)]
    return lines[:start] + piece * rng.choice((2, 10, 1000)) + lines[start:]


@_of_lines
def all_numbers(lines: list[str], rng: Random) -> list[str]:
    """Every coordinate far larger, far smaller, or the same."""
    key = rng.choice(("v", "vn", "vt"))
    end = rng.choice(("e30", "e300", "e-30", "e-300", "e9"))
    same = rng.random() < 0.3

    def scaled(line: str) -> str:
        head, *words = line.split(" ")
        return f"{key} 0 0 0" if same else " ".join([head, *(f"{word}{end}" for word in words)])

    return [scaled(line) if line.startswith(f"{key} ") else line for line in lines]


@_of_lines
def many_corners(lines: list[str], rng: Random) -> list[str]:
    """One face of a great many corners, in order or astray."""
    count = rng.choice((50, 3000))
    corners = [rng.randint(1, 8) for _ in range(count)] if rng.random() < 0.5 else [k % 8 + 1 for k in range(count)]
    return [*lines, "f " + " ".join(map(str, corners)), ""]


@_of_lines
def ring_of_corners(lines: list[str], rng: Random) -> list[str]:
    """One face around thousands of corners of its own, zigzag: hard to divide into triangles."""
    count = rng.choice((200, 3000))
    points = [f"v {k / count:.6f} {rng.random():.6f} {rng.choice((0.0, rng.random())):.6f}" for k in range(count)]
    return [*points, "f " + " ".join(str(-k - 1) for k in range(count)), *lines]


CHANGES = (
    *(other_word, other_line) * 2,
    *(more_words, fewer_words, fewer_lines, more_lines, all_numbers, many_corners, ring_of_corners),
)
