"""What may stand where a file is named or a part is, and must lead nowhere and reach nothing as it is."""

from random import Random

OUTSIDE = "../outside/secret"  # from the input's folder: what lies there must never be opened
NAMED = (
    *(".obj", ".mtl", ".png", ".jpg", ".bin", ".glb", ".gltf", ".stl", ".ply", ".off"),
    *(".json", ".npz", ".npy", ".urdf"),
)
_NAMES = (
    *("\x1b[31mred\x1b[0m", "\x1b]0;title\x07", "\x9b2J", "a\rb", "a\nb", "a\tb", "a\0b", "\x7f"),
    *("\u2028", "\u202egnp", "CON", "nul.obj", "...", "..", ".", "", " ", "-rf", "--help", "a/b", "../../x"),
    *("a\\b", "/etc/passwd", "~", "<script>alert(1)</script>", "</script><b>", '"><img src=x onerror=alert(1)>'),
    *("{{7*7}}", "${x}", "%s%n", "\ud800", "\U0010ffff", "e\u0301" * 50, "\u200b", "a" * 5000, "a" * 255),
    *("[bold red]x[/]", "[/nope]", "hinge_1", "rail_1", "handle", "world", "base", "root", "door", "Door"),
    *("drawer_1_front", "'; --", "\ufeff", "NaN", "null", "1", "-1"),
)


def hostile_place(suffix: str, named: str, rng: Random) -> str:
    """Returns what may stand where a file is named: none of it may be opened, but for the name itself."""
    out = f"{OUTSIDE}{suffix}"
    leads_out = (out, f"../{out}", f"./x/../{out}", f"meshes/../../{out}", out.replace("/", "\\"))
    encoded = (out.replace("/", "%2F"), "%00", "%", "data:", "data:;base64,!", "data:,%ff", f"package://x/{out}")
    absolute = (f"/etc/passwd{suffix}", "/etc/passwd", "/proc/self/environ", "/dev/zero", "/dev/stdin", "/dev/null")
    schemes = (
        "file:///etc/passwd",
        f"file://{out}",
        f"http://127.0.0.1:9/x{suffix}",
        "ftp://a/b",
        f"package://../{out}",
    )
    windows = (f"\\\\host\\share\\x{suffix}", f"C:\\x{suffix}", f"con{suffix}", f"{named}::$DATA")
    odd = ("a" * 5000 + suffix, "a/" * 5000 + f"x{suffix}", f"x\0y{suffix}", f"\ud800{suffix}", f"\udcff{suffix}")
    little = ("", ".", "..", "/", "~", f"~/x{suffix}", "$HOME", "*")
    near = (named.upper(), f"./././{named}", named + "/", named + "\n", f"{named}?x#y", named * 2, f" {named} ")
    return rng.choice(rng.choice((leads_out, leads_out, encoded, absolute, schemes, windows, odd, little, near)))


def hostile_name(rng: Random) -> str:
    """Returns a name that a user might give to a part: none may reach a terminal, a path or a page as it is."""
    return rng.choice(_NAMES)
