"""Continuous-time transfer functions from frequency responses (thesis Section 2.4, Appendix B)."""

from pysim.identify.blackbox.dataset import FittedResponse, fit_dataset
from pysim.identify.blackbox.fit import fit_transfer_function
from pysim.identify.blackbox.orders import Candidate, OrderSuggestion, suggest_orders
from pysim.identify.blackbox.response import WEIGHTS, ComplexResponse, complex_response
from pysim.identify.blackbox.result import FittedNumber, Root, TransferFunctionFit, fit_percent
from pysim.identify.blackbox.structure import Structure
from pysim.identify.blackbox.thesis_form import THESIS_STRUCTURE, from_thesis_row, thesis_row

__all__ = [
    "THESIS_STRUCTURE",
    "WEIGHTS",
    "Candidate",
    "ComplexResponse",
    "FittedNumber",
    "FittedResponse",
    "OrderSuggestion",
    "Root",
    "Structure",
    "TransferFunctionFit",
    "complex_response",
    "fit_dataset",
    "fit_percent",
    "fit_transfer_function",
    "from_thesis_row",
    "suggest_orders",
    "thesis_row",
]
