"""An articulated object as OpenUSD, by Pixar's own library: the only place that imports `pxr`."""
