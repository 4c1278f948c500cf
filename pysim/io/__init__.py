"""Files in and out: .fmu, csv, npz."""

from pysim.io.archive import extracted
from pysim.io.cache import cache_folder
from pysim.io.dataset import read_dataset
from pysim.io.fmu import read_model
from pysim.io.records import read_record, write_record

__all__ = ["cache_folder", "extracted", "read_dataset", "read_model", "read_record", "write_record"]
