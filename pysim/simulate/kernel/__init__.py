"""The native kernel: a library in C that runs FMUs, whole passes in one call."""
