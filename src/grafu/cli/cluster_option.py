"""The option `--cluster`, and arguments that are a path or a URL."""

import argparse

from grafu.cluster.urls import Place, Url, place_of
from grafu.errors import OptionError


def add_cluster_option(parser: argparse.ArgumentParser) -> None:
    """Adds --cluster."""
    parser.add_argument(
        "--cluster",
        metavar="ADDRESS",
        help="work on the machines of a Ray cluster: ray://HOST:10001, HOST:6379, auto (the one that runs here, else "
        "this machine alone) or local; needs grafu[cluster] (docs/cluster.md)",
    )


def place_option(text: str) -> Place:
    """Returns the path or the URL that an argument names; raises argparse's error where it is none."""
    try:
        return place_of(text)
    except OptionError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def is_remote(options: argparse.Namespace) -> bool:
    """Whether models or results are at URLs, or other machines work on them."""
    return options.cluster is not None or any(isinstance(place, Url) for place in (*options.inputs, options.out))
