"""More than one machine: models and results at URLs, and the tasks of a Ray cluster."""
