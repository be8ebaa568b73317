"""Data sets laid out like the authors' releases, read and written. It makes no furniture."""
