"""The functional graph: part nodes, four kinds of edges, motion codes, JSON."""
