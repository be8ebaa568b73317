"""The best weights of a run as the file that the package ships. It writes no files."""

import logging
from dataclasses import asdict

from grafu.network.export import onnx_bytes
from grafu.processes.privacy import keep_private
from grafu.training.checkpoint import BestWeights


def exported(best: BestWeights) -> bytes:
    """Returns an ONNX file; weights are stored in 16 bits and computed with in 32."""
    keep_private()  # the exporter may look whether ONNX Runtime is there
    before = logging.root.manager.disable
    logging.disable(logging.WARNING)  # torch's exporter tells of packages that it does not need
    try:
        return onnx_bytes(best.network(), **asdict(best.config.features), half_weights=True)
    finally:
        logging.disable(before)
