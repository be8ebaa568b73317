"""GraFu, the graph functionalizer, as torch modules: needed to train, not to run."""
