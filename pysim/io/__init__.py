"""Files in and out: .fmu, data sets and their logs, records."""

from pysim.io.archive import extracted
from pysim.io.archive_check import DAMAGED
from pysim.io.binary import check_binary, load_library
from pysim.io.cache import cache_folder
from pysim.io.columns import names_its_columns
from pysim.io.counted import counted
from pysim.io.dataset import SIGNAL_KEYS, described_signal, read_dataset, read_described
from pysim.io.draft_dataset import Draft, clock_column, draft_dataset
from pysim.io.draft_text import draft_text
from pysim.io.file_names import same_file, unusable_name
from pysim.io.files import write_file
from pysim.io.fmu import read_model
from pysim.io.headings import column_names
from pysim.io.load.headings import name_and_unit
from pysim.io.model_units import in_model_units
from pysim.io.named_columns import optional_package
from pysim.io.records import is_written_record, read_record, record_data, record_text, write_record
from pysim.io.signals import read_signal, signal_times, write_signal
from pysim.io.single_log import read_single_log
from pysim.io.stages import StageFile, read_stages, write_stages
from pysim.io.text_table import read_text
from pysim.io.thesis_folder import LOG_SUFFIXES, read_thesis_folder
from pysim.io.toml_section import Section, TomlFile, log_source, read_toml
from pysim.io.toml_text import toml_key, toml_table
from pysim.io.units import SI, shown_point, shown_unit, shown_value, signal_in_si
from pysim.io.write_dataset import write_dataset, write_description
from pysim.types.json_number import json_number

__all__ = [
    "DAMAGED",
    "LOG_SUFFIXES",
    "SI",
    "SIGNAL_KEYS",
    "Draft",
    "Section",
    "StageFile",
    "TomlFile",
    "cache_folder",
    "check_binary",
    "clock_column",
    "column_names",
    "counted",
    "described_signal",
    "draft_dataset",
    "draft_text",
    "extracted",
    "in_model_units",
    "is_written_record",
    "json_number",
    "load_library",
    "log_source",
    "name_and_unit",
    "names_its_columns",
    "optional_package",
    "read_dataset",
    "read_described",
    "read_model",
    "read_record",
    "read_signal",
    "read_single_log",
    "read_stages",
    "read_text",
    "read_thesis_folder",
    "read_toml",
    "record_data",
    "record_text",
    "same_file",
    "shown_point",
    "shown_unit",
    "shown_value",
    "signal_in_si",
    "signal_times",
    "toml_key",
    "toml_table",
    "unusable_name",
    "write_dataset",
    "write_description",
    "write_file",
    "write_record",
    "write_signal",
    "write_stages",
]
