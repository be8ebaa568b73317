"""`grafu edit`: a local server whose page is the report's, made live; what is decided there is kept as settings."""
