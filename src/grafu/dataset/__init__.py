"""Results of many models as one set that others load: shards or folders, an index, splits without near-duplicates.

    from grafu.dataset import load_dataset
    for sample in load_dataset("DIR", split="train"):
        sample.name, sample.report, sample.files["model.glb"]

`grafu.data` is something else: the pairs of graphs that the network is trained on.
"""

from grafu.dataset.reading import ModelSample as ModelSample
from grafu.dataset.reading import load_dataset as load_dataset
