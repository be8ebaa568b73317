"""Work for tasks of a test cluster: each try leaves a file that states its node, and some end their process."""

import os
import signal
from pathlib import Path
from time import sleep
from uuid import uuid4

Named = tuple[str, str]
"""A folder that all nodes see, and the name of an item."""


def work(item: Named) -> str:
    """Returns the item's name, or never returns, as the name states."""
    folder, name = Path(item[0]), item[1]
    (folder / f"{name}.{uuid4().hex}.try").write_text(os.environ.get("RAY_NODE_ID", ""))
    if name == "crashes":
        os._exit(3)
    if name == "kills":
        os.kill(os.getppid(), signal.SIGKILL)
    while name in ("waits", "kills") and not (folder / "go").exists():
        sleep(0.05)
    return name


def tries(folder: Path, name: str) -> list[str]:
    """Returns the nodes on which an item was tried."""
    return [path.read_text() for path in folder.glob(f"{name}.*.try")]
