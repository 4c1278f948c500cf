"""The rig wired to its two controllers, and to a crane where one gives the references."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from pysim.control import Block, CompensatedLoadController, LoadController, SpeedController
from pysim.control.tuning import damping_gain
from pysim.cosim import Connection, Member, Sampled, System
from pysim.types import BadInput

# What the load controller's feed forward takes for the shaft's speed.
Feed = Literal["reference", "measured", "true"]
_FEED: Mapping[str, str] = {"measured": "rig.omegaS", "true": "rig.omega"}

# Worth recording of every run.
OUTPUTS = ("rig.omega", "rig.omegaS", "rig.pL", "rig.pS", "rig.alphaPercent", "speed.alphaCMD", "load.u_ref")


def load_controllers(dt: float) -> dict[str, LoadController | CompensatedLoadController]:
    """The thesis' load controller, with its valve turned round, and both with the gain that calms the shaft.

    Args:
        dt: s between two steps of each.
    """
    plain = LoadController(dt)
    gain = damping_gain(plain.T_i, speed=8.0)
    return {
        "thesis": plain,
        "compensated": CompensatedLoadController(dt),
        "gain for the shaft": LoadController(dt, K_p=gain),
        "both": CompensatedLoadController(dt, K_p=gain * 0.0035),
    }


def rig_system(
    rig: Member,
    *,
    dt: float = 1e-3,
    speed: Block | None = None,
    load: Block | None = None,
    feed: Feed = "reference",
    crane: Member | None = None,
    delay: float = 0.0,
) -> System:
    """Members "rig" and, where given, "crane"; blocks "speed" and "load".

    Without a crane the references are inputs for the experiment: `speed.reference`, `load.reference` and, unless
    another speed is fed forward, `load.speed`. With it `crane.z_v_t` is.

    Args:
        rig: LoadCircuit.Rig, or what has its inputs and outputs, called "rig".
        dt: s between two steps of both controllers.
        speed, load: with this dt and the ports of the thesis' controllers, which they are by default (Table 6.1,
            manually tuned); a load controller with an input "supply" receives the supply pressure too.
        feed: whose flow the load controller feeds forward: the reference's, as in the thesis, the pulses', or the
            true speed's, as a good sensor would tell it.
        crane: Crane.IdealCompensation, called "crane".
        delay: s from a sample to the command.
    Raises:
        BadInput: a member of another name, or without the ports that are needed; an unknown feed.
    """
    if feed != "reference" and feed not in _FEED:
        raise BadInput(f"rig: feed is {feed!r}; give 'reference', 'measured' or 'true'")
    for member, name in ((rig, "rig"), (crane, "crane")):
        if member is not None and member.name != name:
            raise BadInput(f"rig: the member {member.name!r} stands for the {name}; call it {name!r}")
    blocks = (
        Sampled("speed", SpeedController(dt) if speed is None else speed, dt, delay),
        Sampled("load", LoadController(dt) if load is None else load, dt, delay),
    )
    wires = [
        Connection("rig.omegaS", "speed.measured"),
        Connection("speed.alphaCMD", "rig.alphaCMD"),
        Connection("rig.pL", "load.measured"),
        Connection("load.u_ref", "rig.u_ref"),
    ]
    if "supply" in (port.name for port in blocks[1].block.inputs):
        wires.append(Connection("rig.pSupply", "load.supply"))
    if feed in _FEED:
        wires.append(Connection(_FEED[feed], "load.speed"))
    if crane is not None:
        wires += [
            Connection("crane.omegaS_ref", "speed.reference"),
            Connection("crane.pL_ref", "load.reference"),
        ]
        wires += [] if feed in _FEED else [Connection("crane.omegaS_ref", "load.speed")]
    members = (rig, *blocks) if crane is None else (crane, rig, *blocks)
    return System(members, tuple(wires))
