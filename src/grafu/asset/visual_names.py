"""What a shape of a robot description is called: it, its link, and the file of its mesh may have names."""

from grafu.asset.labels import label_of
from grafu.asset.names import spoken
from grafu.vocabulary import PartLabel


def visual_name(visual: str, link: str, stem: str, is_root: bool) -> str:
    """Returns what a shape is called; a root is named as the whole or as its frame, which tells no shape of it.

    A link with a number for a name, such as `link_3`, tells nothing, and the file of the shape may.
    """
    if label_of(link) is PartLabel.HANDLE:
        return link
    names = (visual, stem) if is_root and visual else (visual, link, stem)
    called = next((n for n in names if n and label_of(n) is not PartLabel.UNKNOWN), "")
    return called or visual or next((n for n in (link, stem) if spoken(n)), link or stem)
