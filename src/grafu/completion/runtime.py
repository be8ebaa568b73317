"""The one place that imports ONNX Runtime: late, for that takes 0.2 s, and with its telemetry off."""

from types import ModuleType

from grafu.processes.privacy import keep_private


def onnx_runtime() -> ModuleType:
    """Returns the module `onnxruntime`, which sends nothing and writes nothing of its own.

    If it was imported before, its events are off from now on.
    """
    keep_private()
    import onnxruntime

    onnxruntime.disable_telemetry_events()
    return onnxruntime
