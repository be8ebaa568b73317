"""Work for tasks of a test cluster: each try leaves a file that states its process, and some end their process."""

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
    (folder / f"{name}.{os.getpid()}.{uuid4().hex}.try").touch()
    if name == "crashes":
        os._exit(3)
    if name == "kills":
        os.kill(os.getppid(), signal.SIGKILL)
    while name in ("waits", "kills") and not (folder / "go").exists():
        sleep(0.05)
    return name


def tries(folder: Path, name: str) -> list[int]:
    """Returns the processes in which an item was tried."""
    return [int(path.name.split(".")[1]) for path in folder.glob(f"{name}.*.try")]
