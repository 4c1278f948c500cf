"""A diagnosis, shown: its words, its answer as text and JSON, its page and its pictures."""

from pysim.present.diagnosis.answer import Diagnosed, answered, data, files, placed, text, whole
from pysim.present.diagnosis.figures import figures
from pysim.present.diagnosis.page import page
from pysim.types import Diagnosis

__all__ = ["Diagnosed", "Diagnosis", "answered", "data", "figures", "files", "page", "placed", "text", "whole"]
