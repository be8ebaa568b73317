"""Nothing leaves the machine: the telemetry of libraries is switched off. It imports no library."""

import os

_SWITCH = "ORT_DISABLE_TELEMETRY"  # ONNX Runtime reads it as it is loaded; later it is too late


def keep_private() -> None:
    """Switches off the telemetry of ONNX Runtime, for this process and those that it starts.

    To be called before the library is imported: as it loads, it would make a device id and a queue of events under the
    user's cache folder, and ask for its makers' host.
    """
    os.environ[_SWITCH] = "1"
