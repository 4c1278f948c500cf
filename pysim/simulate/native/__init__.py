"""The machine code of a run: steps, events, recording and derivatives of steps, compiled by Numba.

Functions marked `native` work on the record of a run (`_job.JOB`); Python calls `loop.integrate` and
`variation_loop.integrate_variations` and nothing else of them.
"""
