"""The verb `completion`: prints the script by which a shell completes verbs, options, their values and files."""

import argparse
from collections.abc import Collection, Iterator
from pathlib import Path

from grafu.cli.cluster_option import place_option

_DESCRIPTION = """\
Prints a script for bash, zsh or fish, which then completes verbs, options, their values and file names.
"""
_EXAMPLES = """\
examples:
  grafu completion bash > ~/.grafu-completion   # and `source ~/.grafu-completion` in ~/.bashrc
  grafu completion zsh > ~/.zfunc/_grafu        # and `fpath+=~/.zfunc` before `compinit` in ~/.zshrc
  grafu completion fish > ~/.config/fish/completions/grafu.fish
"""
SHELLS = ("bash", "zsh", "fish")


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser; the parser of the whole command is to be its default `command`."""
    parser = verbs.add_parser(
        "completion",
        help="print a script by which bash, zsh or fish completes",
        description=_DESCRIPTION,
        epilog=_EXAMPLES,
    )
    parser.add_argument("shell", choices=SHELLS, metavar="SHELL", help=f"one of {', '.join(SHELLS)}")
    parser.set_defaults(run=run)
    return parser


def run(options: argparse.Namespace) -> int:
    """Prints the script and returns 0."""
    import sys

    sys.stdout.write(script(options.command, options.shell) + "\n")
    return 0


def script(parser: argparse.ArgumentParser, shell: str) -> str:
    """Returns the script for a shell that completes what the parser reads; the parser is marked for it."""
    import shtab

    known = _known_values()
    _describe_shortly(parser)
    for action in _actions(parser):
        if action.type in (Path, place_option):
            action.complete = shtab.FILE  # type: ignore[attr-defined]  # shtab reads it
        elif action.dest == "formats":
            action.complete = _completed_list(known[action.dest])  # type: ignore[attr-defined]
        elif action.choices is None and action.dest in known:
            action.choices = list(known[action.dest])
    return shtab.complete(parser, shell=shell)


def _describe_shortly(parser: argparse.ArgumentParser) -> None:
    """Gives each verb its one line of `grafu --help` as its description, which a shell shows beside it."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for verb in action._get_subactions():
                action.choices[verb.dest].description = verb.help


def _completed_list(names: Collection[str]) -> dict[str, object]:
    """Returns how each shell completes the last of several names with commas between them."""
    every = " ".join(names)
    bash = f"""
_grafu_names() {{
  compgen -P "${{1%"${{1##*,}}"}}" -W "{every}" -- "${{1##*,}}"
}}
"""
    fish = f"""
function _grafu_names
  printf '%s\\n' (string replace -r '[^,]*$' '' -- (commandline -ct)){{{",".join(names)}}}
end
"""
    of_shells = {"bash": "_grafu_names", "zsh": f" _values -s , name {every}", "fish": "(_grafu_names)"}
    return {**of_shells, "preamble": {"bash": bash, "fish": fish}}


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """Yields the actions of a parser and of its verbs."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for of_verb in action.choices.values():
                yield from _actions(of_verb)
        else:
            yield action


def _known_values() -> dict[str, Collection[str]]:
    """Returns the first words of options whose values argparse does not list."""
    from grafu.articulation.base import BaseKind
    from grafu.articulation.catch_kind import CatchKind
    from grafu.cli.part_options import GRIPS, TOP_SHAPES
    from grafu.export.formats import FORMATS
    from grafu.pipeline.motion_source import MotionSource
    from grafu.templates.gallery import builtin_gallery, open_handles

    axes = [f"{sign}{axis}" for axis in "XYZ" for sign in "+-"]
    return {
        "formats": [*FORMATS, "list"],
        "motion": [str(source) for source in MotionSource],
        "handle": [*open_handles(None), *GRIPS],
        "hinge": [model.id for model in builtin_gallery().hinges],
        "top": TOP_SHAPES,
        "base": [str(kind) for kind in BaseKind],
        "catch": [str(kind) for kind in CatchKind],
        "interior": ["none", "predicted", "auto"],
        "up": axes,
        "front": axes,
    }
