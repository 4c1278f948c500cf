"""The table of `pysim demo` against the independent result and the thesis."""
