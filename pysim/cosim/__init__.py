"""Systems of FMUs and controllers, wired together and stepped."""

from pysim.cosim.bond import Bond
from pysim.cosim.connection import Connection
from pysim.cosim.cosimulate import cosimulate
from pysim.cosim.doubling import Doubling
from pysim.cosim.gauss_seidel import GaussSeidel
from pysim.cosim.iterated import Iterated
from pysim.cosim.jacobi import Jacobi
from pysim.cosim.member import Member, MemberFailed, Setup
from pysim.cosim.order import Order
from pysim.cosim.run import Kept, Run
from pysim.cosim.sampled import Sampled
from pysim.cosim.system import System
from pysim.cosim.system_file import SystemFile, read_system_file

__all__ = [
    "Bond",
    "Connection",
    "Doubling",
    "GaussSeidel",
    "Iterated",
    "Jacobi",
    "Kept",
    "Member",
    "MemberFailed",
    "Order",
    "Run",
    "Sampled",
    "Setup",
    "System",
    "SystemFile",
    "cosimulate",
    "read_system_file",
]
