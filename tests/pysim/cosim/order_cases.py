"""Every order of stepping, for the tests that all have to pass."""

from pysim.cosim import GaussSeidel, Iterated, Jacobi

ORDERS = (
    Jacobi(),
    Jacobi(lines=True),
    GaussSeidel(),
    GaussSeidel(lines=True),
    GaussSeidel(order=("right", "left")),
    GaussSeidel(order=("right", "left"), lines=True),
    Iterated(),
)
