"""Table 5.1 from the data sheets by Eq. 5.5, 5.6, 5.17 and 5.22."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from validation.findings import Finding
from validation.thesis.numbers import published


def run() -> Iterator[Finding]:
    """What can be had from other numbers of the thesis; volumes, c and J_eff are estimates of its authors."""
    t = published(__file__)
    motor = t["V_m"] / (2 * np.pi)
    yield Finding("K_s of Eq. 5.22 at full angle, off the printed", abs(motor - t["K_s"]), 0.5e-10, "m3/rad")
    pump = t["V_d"] * t["speed"] / 60 / np.deg2rad(t["alpha_max"])
    yield Finding(f"K_P of Eq. 5.17 is {pump:.6f}, off the printed", abs(pump - t["K_P"]), 0.5e-4, "m3/(s rad)")
    # Eq. 5.5 and 5.6 have the supply pressure in them, which is nowhere printed: one pressure has to serve both
    by_qu = t["rho"] * (t["K_qu"] / t["K_sv"]) ** 2
    by_qp = (t["u_ss"] * t["K_sv"] / (2 * t["K_qp"])) ** 2 / t["rho"]
    claim = f"supply pressure by K_qu {by_qu / 1e5:.0f} bar, by K_qp {by_qp / 1e5:.0f} bar: apart"
    spread = by_qu * 2 * 0.5e-4 / t["K_qu"] + by_qp * 2 * 0.5e-14 / t["K_qp"]
    yield Finding(claim, abs(by_qu - by_qp) / 1e5, spread / 1e5, "bar, the rounding of both")
    ratio = t["J_eff"] / (2 * t["J_m"])
    claim = f"J_eff is {ratio:.1f} times both motors' own inertia, the rest being shaft and coupling; short of 1 by"
    yield Finding(claim, max(0.0, 1 - ratio), 0, "")
