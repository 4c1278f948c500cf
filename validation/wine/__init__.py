"""The Windows binary, loaded and stepped under Wine."""
