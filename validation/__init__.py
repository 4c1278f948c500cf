"""Published and independent results, and what redoes them: `python -m validation --list`."""
