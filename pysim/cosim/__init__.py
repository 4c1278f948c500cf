"""Systems of FMUs and controllers, wired together and stepped."""

from pysim.cosim.member import Member, MemberFailed, Setup

__all__ = ["Member", "MemberFailed", "Setup"]
