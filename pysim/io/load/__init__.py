"""Logs as they come: any usual file or table, its units from its headings, its clock from its values."""

from pysim.io.load.frame import is_frame
from pysim.io.load.load import Loaded, load_logs
from pysim.io.load.sources import READERS, tables_of
from pysim.io.load.table import RawTable

__all__ = ["READERS", "Loaded", "RawTable", "is_frame", "load_logs", "tables_of"]
