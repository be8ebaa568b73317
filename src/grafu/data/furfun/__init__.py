"""Data sets laid out like the authors' releases, read and written (official.md 2). It makes no furniture."""
