"""The marks of a verdict's colours, on all pages. They judge nothing."""

from grafu.viewer.markup import Html, tag


def light_of(colour: str) -> Html:
    """Returns a coloured mark that names its colour: nobody must see it to read it."""
    return tag("span", colour, class_=f"light {colour}")
