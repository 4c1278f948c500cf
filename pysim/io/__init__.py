"""Files in and out: .fmu, csv, npz."""

from pysim.io.archive import extracted
from pysim.io.cache import cache_folder
from pysim.io.dataset import read_dataset
from pysim.io.files import write_file
from pysim.io.fmu import read_model
from pysim.io.records import read_record, record_data, record_text, write_record
from pysim.io.signals import read_signal

__all__ = [
    "cache_folder",
    "extracted",
    "read_dataset",
    "read_model",
    "read_record",
    "read_signal",
    "record_data",
    "record_text",
    "write_file",
    "write_record",
]
