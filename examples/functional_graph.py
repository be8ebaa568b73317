"""The functional graph of a model: its nodes, its edges, and the confidence of each decision."""

from collections import Counter

import grafu

asset = grafu.load("samples/sideboard.glb", labels="none")  # categories are predicted, not read from names
result = grafu.functionalize(asset)

for node in result.graph.nodes:
    print(f"{node.id}: {node.label}")
print(dict(Counter(type(edge).__name__ for edge in result.graph.edges)))
for decision in result.made.completion.decisions:
    print(f"{decision.part}: {decision.question} = {decision.choice} ({decision.score:.2f})")
