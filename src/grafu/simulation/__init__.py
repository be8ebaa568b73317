"""Results loaded into MuJoCo, pulled, closed and filled: what `grafu check` measures. It needs `grafu[sim]`."""
