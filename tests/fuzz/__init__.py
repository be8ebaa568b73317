"""A seeded fuzzer of our own over every reader and the whole command; docs/security.md states what it proves.

It changes small models of our own (`changes`), reads them in processes that are watched (`worker`), and states of every
case which rule it broke (`rules`). A case follows from its seed and its index alone.
"""
